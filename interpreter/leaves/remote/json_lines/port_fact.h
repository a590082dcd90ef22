// The facts that a program says of its leaf types and ports: the fields of docs/programs.md, as
// descriptors.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "base/json/reader.h"
#include "leaves/remote/owned_descriptors.h"

namespace lockstep::host {

// The number of a word; throws a JsonError that names the words that there are.
int number_of(std::string_view what, std::string_view word,
              std::initializer_list<std::pair<std::string_view, int>> words);

// For JsonField: stores true or false.
std::function<void(JsonValue)> into_flag(bool& flag);
// Null for "".
const char* keep_or_null(OwnedDescriptors& tables, std::string_view text);

// Adds a port to the last leaf of `tables`.
void read_port_fact(JsonValue value, OwnedDescriptors& tables);

}  // namespace lockstep::host

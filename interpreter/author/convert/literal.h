// Values of attributes as scripts of both languages write them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/core/value.h"

namespace lockstep::host {

// A number, true, false, or a text in quotation marks; "" if a script cannot write it. Without a
// type, a number or a bool only where its text is the same again: "007" and "1.0" are texts.
std::string literal_of(std::string_view text, std::optional<ValueType> type);

}  // namespace lockstep::host

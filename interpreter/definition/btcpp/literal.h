// Texts of documents for BehaviorTree.CPP as values.
#pragma once

#include <optional>
#include <string_view>

#include "core/node_type.h"

namespace lockstep::btcpp {

// Nothing if it is no value of the type.
std::optional<Value> read_literal(ValueType type, const ObjectType* object, std::string_view text);

// What is behind the number at the front of a literal that is one.
std::string_view ignored_tail(const Parameter& parameter, std::string_view text);

std::optional<bool> read_bool(std::string_view text);

// As which type the value of an attribute of a SubTree begins: Int, Double or String.
ValueType literal_type(std::string_view text);

}  // namespace lockstep::btcpp

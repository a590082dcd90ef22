// Checks whether a parameter accepts a value: the loader checks constants, a run checks entries.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/node_type.h"

namespace lockstep::host {

// The type in words: "int", or the name of a type of objects.
std::string_view type_name(ValueType type, const ObjectType* object);

// parse_value and expected_text, also of objects.
std::optional<Value> parse_value(ValueType type, const ObjectType* object, std::string_view text);
std::string expected_text(ValueType type, const ObjectType* object);
// The plugin's own words about a text that is none of its objects, as a hint. "" if it has none,
// and for a null type.
std::string why_no_object(const ObjectType* object, std::string_view text);

// The error in `value`, which has the parameter's type: outside of its range, or not among its
// choices. The message does not mention where the value comes from.
std::optional<RuleBreak> refuse_value(const Parameter& parameter, const Value& value);

// Whether the parameter takes the value that the text means.
bool takes_text(const Parameter& parameter, std::string_view text);

// A value that the parameter takes, for one that is to be tried out; NoValue if none is known.
Value sample_value(const Parameter& parameter);

// All that is wrong in a list: items that are no numbers, those outside of the range, and what the
// rule of the node says of the others. `parameter` is one of `type`.
struct ListErrors {
  std::vector<std::string_view> no_numbers;
  std::vector<RuleBreak> refused;
};
ListErrors list_errors(const NodeType& type, const Parameter& parameter, std::string_view text);

// The same as a text, with the value of the entry that a run has read: what, parameter, value,
// entry, hint.
std::string refusal_text(const RuleBreak& why, std::string_view parameter, const Value& value,
                         std::string_view entry);

// "from 0 to 1", "more than 0, at most 1", …; "" when every number is allowed.
std::string range_text(const Range& range);

}  // namespace lockstep::host

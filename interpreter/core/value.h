// The values that parameters, ports and blackboard entries hold, and how they are written in text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace lockstep {

enum class ValueType : std::uint8_t { Bool, Int, Double, String, DoubleList };

// The alternatives stand in the order of ValueType; monostate is "no value yet".
using Value =
    std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>>;

// "bool", "int", "double", "string", "list of double".
std::string_view to_string(ValueType type);

// The whole text as a value of `type`, or nothing. Blanks around it do not count, except in a
// string. bool: true, false, 1, 0. double: decimal, finite. list: separated by ; or , or blanks.
std::optional<Value> parse_value(ValueType type, std::string_view text);

// What parse_value accepts for `type`, for a message: "a number", "true or false", …
std::string_view expected_text(ValueType type);

// The value as text that parse_value reads back to the same value; "" for no value.
std::string to_text(const Value& value);
// The same at the end of `out`; allocates only where that has no room.
void append_text(const Value& value, std::string& out);

// A finite decimal number that is the whole of `text`, or nothing.
std::optional<double> parse_double(std::string_view text);
std::optional<std::int64_t> parse_int(std::string_view text);

}  // namespace lockstep

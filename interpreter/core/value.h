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

// An entry that nobody has written. Not std::monostate: libstdc++ 12 assumes that a variant of it,
// numbers, strings and vectors always has a value, and crashes when copying one throws.
struct NoValue {
  NoValue() = default;
  NoValue(const NoValue&) noexcept {}
  NoValue& operator=(const NoValue&) noexcept { return *this; }
  bool operator==(const NoValue&) const = default;
};

// The alternatives are in the order of ValueType.
using Value = std::variant<NoValue, bool, std::int64_t, double, std::string, std::vector<double>>;

// "bool", "int", "double", "string", "list of double".
std::string_view to_string(ValueType type);

// The whole text as a value of `type`, or nothing. Blanks around it are ignored, except in a
// string. bool: true, false, 1, 0. double: decimal, finite. list: separated by ; or , or blanks.
std::optional<Value> parse_value(ValueType type, std::string_view text);

// What parse_value accepts for `type`, for a message: "a number", "true or false", …
std::string_view expected_text(ValueType type);

// The value as text that parse_value reads back to the same value; "" for no value.
std::string to_text(const Value& value);
// Appends the same to `out`; allocates only if `out` has no room.
void append_text(const Value& value, std::string& out);

// A finite decimal number that is the whole of `text`, or nothing.
std::optional<double> parse_double(std::string_view text);
std::optional<std::int64_t> parse_int(std::string_view text);

}  // namespace lockstep

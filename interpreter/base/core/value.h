// The values that parameters, ports and blackboard entries hold, and how they are written in text.
// The table of types in value.cpp has what the rest of the program needs to know about a type.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/core/object.h"

namespace lockstep::host {

// Number, "int or double", is a type of ports and entries; a value is one of the two.
enum class ValueType : std::uint8_t {
  Number,
  Bool,
  Int,
  Double,
  String,
  DoubleList,
  IntList,
  BoolList,
  StringList,
  Object  // of a type that a plugin declares: ObjectType
};

// An entry that nobody has written. Not std::monostate: libstdc++ 12 assumes that a variant of it,
// numbers, strings and vectors always has a value, and crashes when copying one throws.
struct NoValue {
  NoValue() = default;
  NoValue(const NoValue&) noexcept {}
  NoValue& operator=(const NoValue&) noexcept { return *this; }
  bool operator==(const NoValue&) const = default;
};

// An item of a list of bool: std::vector<bool> has no array of them.
struct Flag {
  bool is_set = false;
  bool operator==(const Flag&) const = default;
};

// The alternative of each ValueType but Number has its number as index.
using Value =
    std::variant<NoValue, bool, std::int64_t, double, std::string, std::vector<double>,
                 std::vector<std::int64_t>, std::vector<Flag>, std::vector<std::string>, Object>;

// True if a value of this type has been written.
bool holds(const Value& value, ValueType type);

// "bool", "int", "double", "string", "list of double", …
std::string_view to_string(ValueType type);

// The whole text as a value of `type`, or nothing. Blanks around it are ignored, except in a
// string. bool: true, false, 1, 0. double: decimal, finite. list: separated by ; or , or blanks; of
// strings by ; only, and a backslash takes the character after it as it is.
// Nothing for an object; see ObjectType::from_text.
std::optional<Value> parse_value(ValueType type, std::string_view text);

// A description of the texts that parse_value accepts for `type`: "a number", "true or false", …
std::string_view expected_text(ValueType type);

// The value as text that parse_value reads back to the same value; "" for no value. Of an object
// what its type makes of it.
std::string to_text(const Value& value);
// Appends the same to `out`; allocates only if `out` has no room.
void append_text(const Value& value, std::string& out);

// A finite decimal number that is the whole of `text`, or nothing.
// The words for yes and no: true, True, TRUE, 1; false, False, FALSE, 0.
std::optional<bool> parse_flag(std::string_view text);
std::optional<double> parse_double(std::string_view text);
std::optional<std::int64_t> parse_int(std::string_view text);

// The texts of a type in the XSD: a simple type, with the pattern that restricts its base.
struct SchemaType {
  std::string_view name;
  std::string_view base = {};     // "": the schema language has the type
  std::string_view pattern = {};  // "": none
  std::string_view doc = {};
};
const SchemaType& schema_type(ValueType type);
std::span<const ValueType> all_value_types();

}  // namespace lockstep::host

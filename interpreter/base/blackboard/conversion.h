// Values that become values of another type, where a script or a port asks for it. Texts are read
// more freely than base/core/value.h reads them: what follows a number is ignored.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/core/value.h"

namespace lockstep::host {

// Up to it, every whole number is exact as a double.
inline constexpr std::int64_t kLargestExact = (std::int64_t{1} << 53) - 1;

template <class T>
struct FromText {
  T value;
  bool has_rest;  // the text goes on after it, which is ignored
};

// The number that a text begins with: [-] digits [. digits] [exponent], inf or nan.
std::optional<FromText<double>> number_from_text(std::string_view text);
// A text as a value of that type.
std::optional<FromText<Value>> value_from_text(ValueType type, const ObjectType* object,
                                               std::string_view text);

// Nothing: not exactly.
std::optional<double> to_real(std::int64_t number);
std::optional<std::int64_t> to_whole(double number);
// A number as a condition: a whole one must be 0 or 1, another must not be negative.
std::optional<bool> to_condition(const Value& value);

// A value that is no text, as one of another type; nothing: it has no such value.
std::optional<Value> cast_value(const Value& value, ValueType type, const ObjectType* object);
// Any value: a text is read, others are cast.
std::optional<Value> convert_value(const Value& value, ValueType type, const ObjectType* object);

// As the text of a number in a script: a real one has six decimals.
void append_plain(std::int64_t number, std::string& out);
void append_plain(double number, std::string& out);

}  // namespace lockstep::host

#include "language/property/entry_comparison.h"

#include <cmath>

#include "language/expression/equal.h"
#include "language/property/nearly.h"

namespace lockstep::host {

bool EntryComparison::holds_for_number(double value) const {
  return std::isfinite(value) ? are_nearly(value, relation, *number, kEqualWithin)
                              : holds_without_value();
}

bool EntryComparison::holds_for_text(std::string_view value) const {
  if (value.size() > kLongest) return holds_without_value();
  if (number) {
    const auto read = parse_double(value);
    return read ? holds_for_number(*read) : holds_without_value();
  }
  return (value == text) == (relation == Relation::Equal);
}

bool EntryComparison::holds_for(const Value& value, std::string& room) const {
  if (std::holds_alternative<NoValue>(value)) return holds_without_value();
  if (number) {
    if (const auto* real = std::get_if<double>(&value)) return holds_for_number(*real);
    if (const auto* whole = std::get_if<std::int64_t>(&value)) {
      return holds_for_number(static_cast<double>(*whole));
    }
    if (std::holds_alternative<bool>(value)) return holds_without_value();
  }
  if (const auto* flag = std::get_if<bool>(&value)) return holds_for_text(*flag ? "true" : "false");
  if (const auto* string = std::get_if<std::string>(&value)) return holds_for_text(*string);
  room.clear();
  append_text(value, room);
  return holds_for_text(room);
}

}  // namespace lockstep::host

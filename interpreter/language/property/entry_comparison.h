// An entry compared with a constant: {place} == 'kitchen', {charge} < 0.2. It means the text of the
// entry's value as recordings have it, so that a live value and a recorded one compare alike.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/core/value.h"
#include "language/expression/program.h"

namespace lockstep::host {

struct EntryComparison {
  // Recordings do not show a longer value: it is a value, but equals no constant.
  static constexpr std::size_t kLongest = 256;  // bytes of its text

  std::uint32_t entry = 0;  // its number
  Relation relation = Relation::Equal;
  std::optional<double> number = {};  // none: `text` is compared
  std::string text = {};

  // Without a value: only != is true.
  bool holds_without_value() const { return relation == Relation::NotEqual; }
  bool holds_for_text(std::string_view value) const;
  // `room` is for the text of what is neither a number, a bool nor a string.
  bool holds_for(const Value& value, std::string& room) const;

  friend bool operator==(const EntryComparison&, const EntryComparison&) = default;

 private:
  bool holds_for_number(double value) const;
};

}  // namespace lockstep::host

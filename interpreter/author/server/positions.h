// Positions of the protocol, a line and a column in UTF-16 code units from 0 on, and the bytes of a
// text in UTF-8.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/json/json.h"
#include "language/document/byte_range.h"

namespace lockstep::host {

struct Position {
  std::uint64_t line = 0, character = 0;
  friend auto operator<=>(const Position&, const Position&) = default;
};

class Positions {
 public:
  // A line ends with "\n", "\r\n" or "\r". The text must outlive this.
  explicit Positions(std::string_view text);

  // One that is outside of the text is its nearest byte: the end of the line, or of the text.
  std::size_t byte_at(Position position) const;
  Position position_of(std::size_t byte) const;
  Json json(std::size_t byte) const;
  Json json(ByteRange range) const;

 private:
  std::string_view line(std::size_t number) const;  // without its end
  std::size_t units_between(std::size_t begin, std::size_t end) const;

  std::string_view text_;
  std::vector<std::size_t> starts_;  // of the lines
  // UTF-16 units of the text before each block, so that a place in a line of megabytes is found as
  // fast as any. Empty: no line is longer than a block.
  std::vector<std::size_t> units_;
};

}  // namespace lockstep::host

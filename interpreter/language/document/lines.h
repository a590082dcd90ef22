// The lines of a text: maps bytes to lines, and returns the text of a line. Only messages need it,
// so it is made when the first place is looked up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace lockstep::host {

struct LineColumn {
  std::uint32_t line;
  std::uint32_t column;
};

// Stores how many lines begin in each block of the text, and counts the rest on demand. So a text
// of line ends only needs no more memory than any other.
class LineIndex {
 public:
  explicit LineIndex(std::string_view text);
  LineColumn locate(std::size_t offset) const;
  // Line 1 is the first; without its line end. "" when there is no such line.
  std::string_view line(std::uint32_t number) const;

 private:
  // Where the line with that number begins, counted from 1. It must be there.
  std::size_t start_of(std::uint32_t number) const;

  std::string_view text_;
  std::vector<std::uint32_t> ends_;  // line ends before each block, and in all of the text
};

}  // namespace lockstep::host

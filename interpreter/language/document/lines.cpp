#include "language/document/lines.h"

#include <algorithm>

namespace lockstep::host {

namespace {

constexpr std::size_t kChunk = 1024;

std::uint32_t count_ends(std::string_view text) {
  return static_cast<std::uint32_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

LineIndex::LineIndex(std::string_view text) : text_(text), ends_{0} {
  ends_.reserve(text.size() / kChunk + 2);
  for (std::size_t begin = 0; begin < text.size(); begin += kChunk)
    ends_.push_back(ends_.back() + count_ends(text.substr(begin, kChunk)));
}

LineColumn LineIndex::locate(std::size_t offset) const {
  const auto block = offset / kChunk;
  const auto line =
      1 + ends_[block] + count_ends(text_.substr(block * kChunk, offset - block * kChunk));
  return {line, static_cast<std::uint32_t>(offset - start_of(line) + 1)};
}

std::size_t LineIndex::start_of(std::uint32_t number) const {
  if (number == 1) return 0;
  // The line end before it is the n-th of its block.
  const auto after = std::lower_bound(ends_.begin(), ends_.end(), number - 1);
  const auto block = static_cast<std::size_t>(after - ends_.begin()) - 1;
  auto end = block * kChunk;
  for (auto n = number - 1 - ends_[block]; n > 0; --n) end = text_.find('\n', end) + 1;
  return end;
}

std::string_view LineIndex::line(std::uint32_t number) const {
  if (number == 0 || number > ends_.back() + 1) return {};
  const auto begin = start_of(number);
  const auto end = number > ends_.back() ? text_.size() : start_of(number + 1) - 1;
  auto line = text_.substr(begin, end - begin);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

}  // namespace lockstep::host

#include "run/leaf_lines.h"

#include <algorithm>
#include <iterator>

namespace lockstep::host {

void LeafLines::add(std::string_view who, std::string_view level, std::string_view text) {
  const Lock lock(mutex_);
  const std::size_t size = sizeof(LeafLine) + who.size() + text.size();
  if (size_ + size > kRoom) {
    ++left_out_;
    return;
  }
  size_ += size;
  new_.push_back({std::string(who), std::string(level), std::string(text)});
  has_new_ = true;
}

std::span<const LeafLine> LeafLines::lines() {
  if (has_new_.exchange(false)) {
    const Lock lock(mutex_);
    std::ranges::move(new_, std::back_inserter(waiting_));
    new_.clear();
  }
  return waiting_;
}

void LeafLines::keep() {
  if (waiting_.empty()) return;
  waiting_.clear();
  const Lock lock(mutex_);
  size_ = 0;
  for (const LeafLine& line : new_) {
    size_ += sizeof(LeafLine) + line.who.size() + line.text.size();
  }
}

void RecentLines::add(const LeafLine& line) {
  if (lines.size() < kMost) {
    lines.push_back(line);
    return;
  }
  std::rotate(lines.begin(), lines.begin() + 1, lines.end());
  lines.back() = line;
  ++earlier;
}

}  // namespace lockstep::host

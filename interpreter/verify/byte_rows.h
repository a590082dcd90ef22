// Rows of bytes, each with a number, that only become more. They are kept in groups of exactly the
// size that they need, so little room is left free, and none is moved to make room for others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace lockstep::host {

class ByteRows {
 public:
  void add(std::span<const std::byte> row);
  // Valid until the next row is added.
  std::span<const std::byte> operator[](std::size_t row) const {
    const Group& group = groups_[row / kRows - gone_];
    const std::size_t place = row % kRows;
    const std::uint32_t begin = place == 0 ? 0 : group.ends[place - 1];
    return std::span(group.bytes).subspan(begin, group.ends[place] - begin);
  }
  std::size_t size() const { return size_; }
  void clear();
  // Gives back the memory of the rows before this one, which are not asked for any more.
  void forget_before(std::size_t row);
  std::size_t memory() const { return groups_.size() * sizeof(Group) + bytes_; }

 private:
  static constexpr std::size_t kRows = 64;
  struct Group {
    std::vector<std::byte> bytes;
    std::array<std::uint32_t, kRows> ends;
  };

  std::deque<Group> groups_;
  std::size_t gone_ = 0;  // groups in front of them
  std::size_t size_ = 0;
  std::size_t bytes_ = 0;  // of all groups
};

}  // namespace lockstep::host

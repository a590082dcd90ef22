#include "verify/byte_rows.h"

#include <limits>
#include <stdexcept>

namespace lockstep::host {

void ByteRows::add(std::span<const std::byte> row) {
  const std::size_t place = size_ % kRows;
  if (size_ / kRows - gone_ == groups_.size()) groups_.emplace_back();
  Group& group = groups_[size_ / kRows - gone_];
  const std::size_t before = group.bytes.capacity();
  if (group.bytes.size() + row.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw std::length_error("64 states have more than 4 GiB of ticks");
  }
  group.bytes.insert(group.bytes.end(), row.begin(), row.end());
  group.ends[place] = static_cast<std::uint32_t>(group.bytes.size());
  ++size_;
  if (place + 1 == kRows) group.bytes.shrink_to_fit();
  bytes_ += group.bytes.capacity() - before;
}

void ByteRows::clear() {
  for (Group& group : groups_) group.bytes.clear();
  size_ = gone_ = 0;
}

void ByteRows::forget_before(std::size_t row) {
  for (; gone_ < row / kRows; ++gone_) {
    bytes_ -= groups_.front().bytes.capacity();
    groups_.pop_front();
  }
}

}  // namespace lockstep::host

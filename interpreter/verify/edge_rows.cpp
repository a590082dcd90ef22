#include "verify/edge_rows.h"

#include <algorithm>

#include "verify/packed_numbers.h"

namespace lockstep::host {
namespace {

// The last bits of a number say what it is of.
enum Kind : std::uint64_t {
  kSameLabel = 0b00,   // an edge: how far its goal is from the one before it
  kRow = 0b10,         // so many edges with that label, each to the next state
  kOtherLabel = 0b01,  // as the first, of one bit more; its label follows
};

// A row of no edges, which is never there, says that a label of the end follows.
constexpr std::byte kEnd{kRow};

}  // namespace

EdgeRow::EdgeRow(std::span<const std::byte> row) : bytes_(row) {
  if (bytes_.empty() || bytes_.front() != kEnd) return;
  bytes_ = bytes_.subspan(1);
  label_of_end_ = static_cast<std::uint32_t>(take_number(bytes_));
}

void EdgeRows::add(std::span<const Edge> edges, std::optional<std::uint32_t> label_of_end) {
  packed_.clear();
  if (label_of_end) {
    packed_.push_back(kEnd);
    put_number(packed_, *label_of_end);
  }
  Edge before;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t row = 0;
    while (i + row < edges.size() &&
           edges[i + row] == Edge{before.to + static_cast<StateId>(row) + 1, before.label}) {
      ++row;
    }
    const Edge& edge = edges[i + (row == 0 ? 0 : row - 1)];
    const std::uint64_t distance = edge.to - before.to;
    if (row > 0) {
      put_number(packed_, row * 4 + kRow);
    } else if (edge.label == before.label) {
      put_number(packed_, distance * 4 + kSameLabel);
    } else {
      put_number(packed_, distance * 2 + kOtherLabel);
      put_number(packed_, edge.label);
    }
    before = edge;
    i += std::max<std::size_t>(1, row);
  }
  rows_.add(packed_);
  size_ += edges.size();
}

EdgeRow::Iterator& EdgeRow::Iterator::operator++() {
  if (row_ > 0) {
    --row_;
    ++edge_.to;
    return *this;
  }
  is_over_ = bytes_.empty();
  if (is_over_) return *this;
  const std::uint64_t head = take_number(bytes_);
  if ((head & kOtherLabel) != 0) {
    edge_.to += static_cast<StateId>(head / 2);
    edge_.label = static_cast<std::uint32_t>(take_number(bytes_));
  } else if ((head & kRow) != 0) {
    row_ = static_cast<std::uint32_t>(head / 4 - 1);
    ++edge_.to;
  } else {
    edge_.to += static_cast<StateId>(head / 4);
  }
  return *this;
}

}  // namespace lockstep::host

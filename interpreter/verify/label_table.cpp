#include "verify/label_table.h"

#include <algorithm>

namespace lockstep::host {
namespace {

void swap_bits(LabelTable::Bits& bits, std::size_t one, std::size_t other) {
  if (LabelTable::has(bits, one) == LabelTable::has(bits, other)) return;
  bits[one / 8] ^= std::byte{1} << one % 8;
  bits[other / 8] ^= std::byte{1} << other % 8;
}

}  // namespace

std::vector<std::byte> LabelShape::swapped(std::span<const std::byte> label, std::size_t one,
                                           std::size_t other) const {
  LabelTable::Bits bits(label.begin(), label.end());
  if (!has_equal(label)) return bits;
  const auto put = [&](std::size_t number, std::size_t value) {
    const auto place = static_cast<Place>(value);
    std::memcpy(bits.data() + bytes() + number * sizeof place, &place, sizeof place);
  };
  const auto swap_places = [&](std::size_t a, std::size_t b) {
    put(a, read_place(label, b));
    put(b, read_place(label, a));
  };
  swap_bits(bits, worked_bit(moving_leaves[one]), worked_bit(moving_leaves[other]));
  swap_bits(bits, ended_bit(moving_leaves[one]), ended_bit(moving_leaves[other]));
  swap_places(one, other);
  if (held_of_leaf[one] != kNowhere) {
    const std::size_t first = held_of_leaf[one], second = held_of_leaf[other];
    swap_bits(bits, held_bit(moving_held[first]), held_bit(moving_held[second]));
    swap_places(moving_leaves.size() + first, moving_leaves.size() + second);
  }
  for (std::size_t i = 0; i < moving_leaves.size(); ++i) {
    if (i != one && equal_before(label, i) == one) {
      const std::size_t before = equal_before(label, one);
      put(moves() + i, before == one ? i : before);
    }
  }
  put(moves() + one, one);
  return bits;
}

}  // namespace lockstep::host

#include "verify/label_table.h"

#include <algorithm>
#include <numeric>

#include "verify/packed_numbers.h"

namespace lockstep::host {
namespace {

// A number that is near 0, as one that is small.
std::uint64_t folded(std::int64_t number) {
  return static_cast<std::uint64_t>(number) << 1u ^ static_cast<std::uint64_t>(number >> 63u);
}
std::int64_t unfolded(std::uint64_t number) {
  return static_cast<std::int64_t>(number >> 1u) ^ -static_cast<std::int64_t>(number & 1u);
}

void exchange_bits(Label& label, std::size_t one, std::size_t other) {
  if (label.has(one) == label.has(other)) return;
  label.bits[one / 8] ^= std::byte{1} << one % 8;
  label.bits[other / 8] ^= std::byte{1} << other % 8;
}

void exchange_values(std::vector<MovingPlace>& after, std::size_t one, std::size_t other) {
  const auto at = std::ranges::find(after, static_cast<MovingPlace>(one));
  const auto there = std::ranges::find(after, static_cast<MovingPlace>(other));
  std::iter_swap(at, there);
}

// Each row of bits that are set: its length, and how far it begins behind the one before it.
void pack_bits(const Label& label, std::vector<std::byte>& into) {
  const std::size_t size = label.bits.size() * 8;
  std::size_t end = 0;
  for (std::size_t bit = 0; bit < size;) {
    if (bit % 8 == 0 && label.bits[bit / 8] == std::byte{0}) {
      bit += 8;
      continue;
    }
    if (!label.has(bit)) {
      ++bit;
      continue;
    }
    const std::size_t begin = bit;
    while (bit < size && label.has(bit)) ++bit;
    put_number(into, bit - begin);
    put_number(into, begin - end);
    end = bit;
  }
}

// The same of what moves, and how far it does. Behind a 0, which is no length.
void pack_moves(const Label& label, std::vector<std::byte>& into) {
  const auto moves = [&](std::size_t i) {
    return static_cast<std::int64_t>(label.after[i]) - static_cast<std::int64_t>(i);
  };
  std::size_t end = 0;
  for (std::size_t i = 0; i < label.after.size();) {
    const std::int64_t far = moves(i);
    const std::size_t begin = i;
    while (i < label.after.size() && moves(i) == far) ++i;
    if (far == 0) continue;
    if (end == 0) put_number(into, 0);
    put_number(into, i - begin);
    put_number(into, begin - end);
    put_number(into, folded(far));
    end = i;
  }
}

}  // namespace

void LabelShape::clear(Label& label) const {
  label.bits.assign(begun_bit() / 8 + 1, std::byte{0});
  label.after.resize(moving_leaves.size() + moving_held.size());
  std::iota(label.after.begin(), label.after.end(), MovingPlace{0});
}

void LabelShape::exchange_before(Label& label, std::size_t one, std::size_t other) const {
  if (one == other) return;
  exchange_bits(label, worked_bit(moving_leaves[one]), worked_bit(moving_leaves[other]));
  exchange_bits(label, ended_bit(moving_leaves[one]), ended_bit(moving_leaves[other]));
  std::swap(label.after[one], label.after[other]);
  const std::size_t first = held_of_leaf[one], second = held_of_leaf[other];
  if (first == kNowhere) return;
  exchange_bits(label, held_bit(moving_held[first]), held_bit(moving_held[second]));
  const std::size_t leaves_moving = moving_leaves.size();
  std::swap(label.after[leaves_moving + first], label.after[leaves_moving + second]);
}

void LabelShape::exchange_after(Label& label, std::size_t one, std::size_t other) const {
  if (one == other) return;
  exchange_values(label.after, one, other);
  const std::size_t first = held_of_leaf[one], second = held_of_leaf[other];
  if (first == kNowhere) return;
  exchange_values(label.after, moving_leaves.size() + first, moving_leaves.size() + second);
}

std::uint32_t LabelTable::add(const Label& label) {
  scratch_.clear();
  pack_bits(label, scratch_);
  pack_moves(label, scratch_);
  return add(scratch_);
}

void LabelTable::read(std::uint32_t label, Label& into) const {
  std::span<const std::byte> from = packed_[label];
  for (std::size_t bit = 0; !from.empty();) {
    std::uint64_t length = take_number(from);
    if (length == 0) break;
    for (bit += take_number(from); length > 0; --length) into.set(bit++);
  }
  for (std::size_t i = 0; !from.empty();) {
    std::uint64_t length = take_number(from);
    i += take_number(from);
    const std::int64_t far = unfolded(take_number(from));
    for (; length > 0; --length, ++i) {
      into.after[i] = static_cast<MovingPlace>(static_cast<std::int64_t>(i) + far);
    }
  }
}

bool LabelTable::has(std::uint32_t label, std::size_t bit) const {
  std::span<const std::byte> from = packed_[label];
  for (std::size_t end = 0; !from.empty();) {
    const std::uint64_t length = take_number(from);
    if (length == 0) return false;
    const std::size_t begin = end + take_number(from);
    end = begin + length;
    if (bit < end) return begin <= bit;
  }
  return false;
}

}  // namespace lockstep::host

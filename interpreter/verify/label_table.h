// A label says what matters of a tick for a run that never ends.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "verify/state_store.h"

namespace lockstep::host {

// A label is bits: the leaves that worked and go on, the leaves that ended, who was held, and the
// properties that wait for something. Where equal children may change places, the bits are those
// before the change, and behind them is where each leaf and each child went that may move. Where
// leaves were in equal states and a search took one order of their answers for all, it also says
// which: before the tick they may change places, too.
struct LabelShape {
  std::size_t leaves = 0, held = 0, properties = 0;
  std::vector<std::uint32_t> moving_leaves = {}, moving_held = {};  // those that may move
  // Of each leaf that may move: its place among the children that are held, or kNowhere.
  std::vector<std::uint16_t> held_of_leaf = {};

  std::size_t worked_bit(std::size_t leaf) const { return leaf; }
  std::size_t ended_bit(std::size_t leaf) const { return leaves + leaf; }
  std::size_t held_bit(std::size_t child) const { return 2 * leaves + child; }
  std::size_t owed_bit(std::size_t property) const { return 2 * leaves + held + property; }
  std::size_t bytes() const { return (2 * leaves + held + properties) / 8 + 1; }

  // Where a label takes the leaf or the child with this number: the leaves that may move are the
  // first, then come the children.
  std::size_t place_after(std::span<const std::byte> label, std::size_t moving) const {
    if (label.size() == bytes()) return moving;  // none moves
    return read_place(label, moving);
  }
  // The leaf before this one that was in an equal state, or this one. Both are leaves that may
  // move.
  std::size_t equal_before(std::span<const std::byte> label, std::size_t moving) const {
    if (!has_equal(label)) return moving;
    return read_place(label, moves() + moving);
  }
  bool has_equal(std::span<const std::byte> label) const {
    return label.size() > bytes() + moves() * sizeof(Place);
  }
  // The label of a tick in which these leaves, which may move, have given each other's answers;
  // `one` is not equal to others in it.
  std::vector<std::byte> swapped(std::span<const std::byte> label, std::size_t one,
                                 std::size_t other) const;
  // What moves: leaves and children.
  std::size_t moves() const { return moving_leaves.size() + moving_held.size(); }

  using Place = std::uint16_t;
  static constexpr Place kNowhere = 0xffff;

 private:
  Place read_place(std::span<const std::byte> label, std::size_t number) const {
    Place place = 0;
    std::memcpy(&place, label.data() + bytes() + number * sizeof place, sizeof place);
    return place;
  }
};

// Few labels are different.
class LabelTable {
 public:
  using Bits = std::vector<std::byte>;

  std::uint32_t add(std::span<const std::byte> bits) { return bits_.add(bits).first; }
  std::span<const std::byte> operator[](std::uint32_t label) const { return bits_[label]; }
  std::size_t size() const { return bits_.size(); }
  std::size_t memory() const { return bits_.memory(); }
  static bool has(std::span<const std::byte> bits, std::size_t bit) {
    return (bits[bit / 8] >> bit % 8 & std::byte{1}) != std::byte{0};
  }
  static void set(Bits& bits, std::size_t bit) { bits[bit / 8] |= std::byte{1} << bit % 8; }

 private:
  StateStore bits_;
};

}  // namespace lockstep::host

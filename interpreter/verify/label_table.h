// A label says what matters of a tick for a run that never ends.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "verify/state_store.h"

namespace lockstep::host {

using MovingPlace = std::uint16_t;  // among the leaves that may move, or behind them the children

// A label is bits: of the leaves that ran before the tick, those that worked and go on, and those
// that ended; whether some leaf began; who was held, and the properties that wait for something. An
// activation that begins in a cycle also ends in it, so it is enough to know of those that ran:
// then the ticks to many states have one label. Where equal children may change places, the bits
// are those before the change, and it says where each leaf and each child goes that may move.
struct Label {
  std::vector<std::byte> bits;
  std::vector<MovingPlace> after;  // leaves first

  bool has(std::size_t bit) const {
    return (bits[bit / 8] >> bit % 8 & std::byte{1}) != std::byte{0};
  }
  void set(std::size_t bit) { bits[bit / 8] |= std::byte{1} << bit % 8; }
  void clear(std::size_t bit) { bits[bit / 8] &= ~(std::byte{1} << bit % 8); }

  friend bool operator==(const Label&, const Label&) = default;
};

struct LabelShape {
  std::size_t leaves = 0, held = 0, properties = 0;
  std::vector<std::uint32_t> moving_leaves = {}, moving_held = {};  // those that may move
  // Of each leaf that may move: the place among the children that are held of the one that moves
  // with it, which may be the leaf itself; or kNowhere.
  std::vector<MovingPlace> held_of_leaf = {};

  std::size_t worked_bit(std::size_t leaf) const { return leaf; }
  std::size_t ended_bit(std::size_t leaf) const { return leaves + leaf; }
  std::size_t held_bit(std::size_t child) const { return 2 * leaves + child; }
  std::size_t owed_bit(std::size_t property) const { return 2 * leaves + held + property; }
  std::size_t begun_bit() const { return owed_bit(properties); }

  // Makes it a label in which nothing has happened.
  void clear(Label& label) const;
  // Makes it that of a tick in which these leaves, which may move, did what the other one did.
  void exchange_before(Label& label, std::size_t one, std::size_t other) const;
  // These leaves, which may move, change places behind the tick.
  void exchange_after(Label& label, std::size_t one, std::size_t other) const;

  static constexpr MovingPlace kNowhere = 0xffff;
};

// Few labels are different. They are packed: rows of bits that are set, and rows of what moves as
// far as what is before it.
class LabelTable {
 public:
  std::uint32_t add(const Label& label);
  std::uint32_t add(std::span<const std::byte> packed) { return packed_.add(packed).first; }
  std::span<const std::byte> packed(std::uint32_t label) const { return packed_[label]; }
  // `into` is a label of this shape, in which nothing has happened.
  void read(std::uint32_t label, Label& into) const;
  bool has(std::uint32_t label, std::size_t bit) const;
  std::size_t size() const { return packed_.size(); }
  std::size_t memory() const { return packed_.memory(); }

 private:
  StateStore packed_;
  std::vector<std::byte> scratch_;
};

}  // namespace lockstep::host

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

// Children that may change places: those of one parallel. What may move in each of them, a leaf or
// a child that may be held, is beside each other.
struct MovingChildren {
  struct Place {
    std::size_t leaf, held;  // the first of those that may move
  };
  std::size_t leaves, held;  // in each
  std::vector<Place> places;
};

// Children in equal states change places, so that what is at the place `one` comes to `other`: both
// are leaves that may move, or behind those children that may be held. The children with them that
// are farthest out change places, then those inside of where that came to, and so on.
struct Swap {
  std::size_t one = 0, other = 0;
};

struct LabelShape {
  std::size_t leaves = 0, held = 0, properties = 0;
  std::vector<std::uint32_t> moving_leaves = {}, moving_held = {};  // those that may move
  std::vector<MovingChildren> moving_children = {};                 // the outer ones first

  std::size_t worked_bit(std::size_t leaf) const { return leaf; }
  std::size_t ended_bit(std::size_t leaf) const { return leaves + leaf; }
  std::size_t held_bit(std::size_t child) const { return 2 * leaves + child; }
  std::size_t owed_bit(std::size_t property) const { return 2 * leaves + held + property; }
  std::size_t begun_bit() const { return owed_bit(properties); }

  // Makes it a label in which nothing has happened.
  void clear(Label& label) const;
  void clear_all_but_held(Label& label) const;
  // Makes it that of a tick in which children in equal states have changed places before it.
  void exchange_before(Label& label, const Swap& swap) const;
  // The same behind the tick.
  void exchange_after(Label& label, const Swap& swap) const;
  // Where what was at this place is then.
  std::size_t exchanged(const Swap& swap, std::size_t place) const;

  // Not a label of a tick: each place is after it where the one before it is with which it may
  // change places, if of these children each is in the state of the one before it.
  struct EqualChild {
    std::size_t children, child;
  };
  void set_equals(std::span<const EqualChild> equal, Label& label) const;
  // The same if what is at this place stays there, which is not behind another one that is like it.
  Label equals_beside(const Label& equals, std::size_t place) const;

  // The changes of places that a swap is, the outer ones first: of two of these children.
  struct Exchange {
    std::size_t children, one, other;
  };
  std::vector<Exchange> exchanges(const Swap& swap) const;

 private:
  // The child of these that the place is in, or kNoChild.
  static constexpr std::size_t kNoChild = static_cast<std::size_t>(-1);
  std::size_t child_with(const MovingChildren& all, std::size_t place) const;
  void exchange(std::size_t& place, const Exchange& it) const;
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

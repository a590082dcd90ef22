// States of a search, or other rows of bytes, each with a number, found by a hash table of numbers.
// None is ever forgotten.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "verify/byte_rows.h"

namespace lockstep::host {

using StateId = std::uint32_t;
inline constexpr StateId kNoState = 0xffffffff;

std::uint32_t hash_of(std::span<const std::byte> state);

class StateStore {
 public:
  StateStore() : table_(kFirstSize, kNoState) {}

  // Its number, and whether it is a new one. `hash` is that of the state.
  std::pair<StateId, bool> add(std::span<const std::byte> state, std::uint32_t hash);
  std::pair<StateId, bool> add(std::span<const std::byte> state) {
    return add(state, hash_of(state));
  }
  // kNoState: it is not there. Several threads may look at a time.
  StateId find(std::span<const std::byte> state, std::uint32_t hash) const {
    return table_[place_of(state, hash)];
  }
  std::span<const std::byte> operator[](StateId id) const { return rows_[id]; }
  std::uint32_t hash(StateId id) const { return hashes_[id]; }
  std::size_t size() const { return rows_.size(); }
  std::size_t memory() const;
  void clear();

 private:
  static constexpr std::size_t kFirstSize = 256;

  // Where it is in the table, or where it would be.
  std::size_t place_of(std::span<const std::byte> state, std::uint32_t hash) const;
  void grow();

  ByteRows rows_;
  std::deque<std::uint32_t> hashes_;  // of each state
  std::vector<StateId> table_;        // its size is a power of two
};

}  // namespace lockstep::host

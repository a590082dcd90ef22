// States of a search, or other rows of bytes, each with a number, found by a hash table of numbers.
// A store can keep a hash in place of each state: P. Wolper, D. Leroy, "Reliable Hashing without
// Collision Detection", CAV 1993. Then two states with the same hash are taken for one.
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

std::uint64_t hash_of(std::span<const std::byte> state);

class StateStore {
 public:
  // `hash_bits`: of the hash that is kept in place of a state, at most 64; 0: states are kept.
  explicit StateStore(unsigned hash_bits = 0)
      : mask_(hash_bits == 0 ? 0 : ~std::uint64_t{0} >> (64 - hash_bits)),
        table_(kFirstSize, kNoState) {}

  // Its number, and whether it is a new one. `hash` is that of the state.
  std::pair<StateId, bool> add(std::span<const std::byte> state, std::uint64_t hash);
  std::pair<StateId, bool> add(std::span<const std::byte> state) {
    return add(state, hash_of(state));
  }
  // kNoState: it is not there. Several threads may look at a time.
  StateId find(std::span<const std::byte> state, std::uint64_t hash) const {
    return table_[place_of(state, hash)];
  }
  // Whether this is the state with the number, as far as the store can tell.
  bool is(StateId id, std::span<const std::byte> state) const {
    return is(id, state, hash_of(state));
  }
  std::span<const std::byte> operator[](StateId id) const { return rows_[id]; }
  std::size_t size() const { return size_; }
  std::size_t memory() const;
  void clear();

  bool keeps_hashes() const { return mask_ != 0; }
  // A store that keeps hashes forgets the states before this one, which are not read any more.
  void forget_before(StateId id) { rows_.forget_before(id); }
  // A bound of the probability that two of its states were taken for one, if hashes are as random
  // numbers: the k-th state has the hash of one before it with a probability of k / 2^bits.
  double probability_of_loss() const;

 private:
  static constexpr std::size_t kFirstSize = 256;

  bool is(StateId id, std::span<const std::byte> state, std::uint64_t hash) const;
  // Where it is in the table, or where it would be.
  std::size_t place_of(std::span<const std::byte> state, std::uint64_t hash) const;
  void grow();

  std::uint64_t mask_;
  ByteRows rows_;
  std::size_t size_ = 0;
  std::deque<std::uint32_t> hashes_;       // of each state, their lower bits
  std::deque<std::uint64_t> long_hashes_;  // where they are kept in place of states
  std::vector<StateId> table_;             // its size is a power of two
};

}  // namespace lockstep::host

#include "verify/state_store.h"

#include <algorithm>
#include <cstring>

namespace lockstep::host {

// Eight bytes at a time, mixed as SplitMix64 does.
std::uint64_t hash_of(std::span<const std::byte> state) {
  std::uint64_t hash = state.size() * 0x9e3779b97f4a7c15u;
  const auto mix = [&hash](std::uint64_t block) {
    hash ^= block;
    hash = (hash ^ (hash >> 30u)) * 0xbf58476d1ce4e5b9u;
    hash ^= hash >> 29u;
  };
  for (; state.size() >= 8; state = state.subspan(8)) {
    std::uint64_t block = 0;
    std::memcpy(&block, state.data(), 8);
    mix(block);
  }
  std::uint64_t rest = 0;
  if (!state.empty()) std::memcpy(&rest, state.data(), state.size());
  mix(rest);
  hash = (hash ^ (hash >> 27u)) * 0x94d049bb133111ebu;
  return hash ^ (hash >> 31u);
}

bool StateStore::is(StateId id, std::span<const std::byte> state, std::uint64_t hash) const {
  if (keeps_hashes()) return long_hashes_[id] == (hash & mask_);
  if (hashes_[id] != static_cast<std::uint32_t>(hash)) return false;
  const std::span<const std::byte> known = rows_[id];
  if (known.size() != state.size()) return false;
  return known.empty() || std::memcmp(known.data(), state.data(), known.size()) == 0;
}

std::size_t StateStore::place_of(std::span<const std::byte> state, std::uint64_t hash) const {
  const std::size_t last = table_.size() - 1;
  std::size_t at = (keeps_hashes() ? hash & mask_ : hash) & last;
  while (table_[at] != kNoState && !is(table_[at], state, hash)) at = (at + 1) & last;
  return at;
}

std::pair<StateId, bool> StateStore::add(std::span<const std::byte> state, std::uint64_t hash) {
  const std::size_t at = place_of(state, hash);
  if (table_[at] != kNoState) return {table_[at], false};
  const auto id = static_cast<StateId>(size_++);
  table_[at] = id;
  if (keeps_hashes()) {
    long_hashes_.push_back(hash & mask_);
  } else {
    hashes_.push_back(static_cast<std::uint32_t>(hash));
  }
  rows_.add(state);
  if (size_ * 3 > table_.size() * 2) grow();
  return {id, true};
}

void StateStore::grow() {
  const std::size_t size = table_.size() * 2;
  table_ = {};  // not both at a time
  table_.assign(size, kNoState);
  const std::size_t last = size - 1;
  for (StateId id = 0; id < size_; ++id) {
    std::size_t at = (keeps_hashes() ? long_hashes_[id] : hashes_[id]) & last;
    while (table_[at] != kNoState) at = (at + 1) & last;
    table_[at] = id;
  }
}

void StateStore::clear() {
  rows_.clear();
  hashes_.clear();
  long_hashes_.clear();
  size_ = 0;
  std::ranges::fill(table_, kNoState);
}

std::size_t StateStore::memory() const {
  return rows_.memory() + (hashes_.size() + table_.capacity()) * sizeof(std::uint32_t) +
         long_hashes_.size() * sizeof(std::uint64_t);
}

double StateStore::probability_of_loss() const {
  if (!keeps_hashes()) return 0;
  const double states = static_cast<double>(size_);
  return std::min(1.0, states * (states + 1) / 2 / (static_cast<double>(mask_) + 1));
}

}  // namespace lockstep::host

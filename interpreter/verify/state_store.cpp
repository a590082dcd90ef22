#include "verify/state_store.h"

#include <algorithm>
#include <cstring>

namespace lockstep::host {

// Eight bytes at a time, mixed as SplitMix64 does.
std::uint32_t hash_of(std::span<const std::byte> state) {
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
  return static_cast<std::uint32_t>(hash >> 32u);
}

std::size_t StateStore::place_of(std::span<const std::byte> state, std::uint32_t hash) const {
  const std::size_t mask = table_.size() - 1;
  std::size_t at = hash & mask;
  for (; table_[at] != kNoState; at = (at + 1) & mask) {
    const StateId id = table_[at];
    if (hashes_[id] != hash) continue;
    const std::span<const std::byte> known = (*this)[id];
    if (known.size() == state.size() &&
        std::memcmp(known.data(), state.data(), known.size()) == 0) {
      break;
    }
  }
  return at;
}

std::pair<StateId, bool> StateStore::add(std::span<const std::byte> state, std::uint32_t hash) {
  const std::size_t at = place_of(state, hash);
  if (table_[at] != kNoState) return {table_[at], false};
  const auto id = static_cast<StateId>(size());
  table_[at] = id;
  hashes_.push_back(hash);
  rows_.add(state);
  if (size() * 3 > table_.size() * 2) grow();
  return {id, true};
}

void StateStore::grow() {
  const std::size_t size = table_.size() * 2;
  table_ = {};  // not both at a time
  table_.assign(size, kNoState);
  const std::size_t mask = table_.size() - 1;
  for (StateId id = 0; id < hashes_.size(); ++id) {
    std::size_t at = hashes_[id] & mask;
    while (table_[at] != kNoState) at = (at + 1) & mask;
    table_[at] = id;
  }
}

void StateStore::clear() {
  rows_.clear();
  hashes_.clear();
  std::ranges::fill(table_, kNoState);
}

std::size_t StateStore::memory() const {
  return rows_.memory() + (hashes_.size() + table_.capacity()) * sizeof(std::uint32_t);
}

}  // namespace lockstep::host

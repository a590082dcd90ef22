// All states that a search has found: their bytes in one long row, found by a hash table of
// numbers. A state is never forgotten.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lockstep::host {

using StateId = std::uint32_t;
inline constexpr StateId kNoState = 0xffffffff;

class StateStore {
 public:
  StateStore() : table_(kFirstSize, kNoState) {}

  // Its number, and whether it is a new one.
  std::pair<StateId, bool> add(std::span<const std::byte> state);
  std::span<const std::byte> operator[](StateId id) const {
    return {bytes_.data() + begins_[id], bytes_.data() + begins_[id + 1]};
  }
  std::size_t size() const { return begins_.size() - 1; }
  std::size_t memory() const;

 private:
  static constexpr std::size_t kFirstSize = 1024;

  void grow();

  std::vector<std::byte> bytes_;
  std::vector<std::uint64_t> begins_{0};
  std::vector<std::uint32_t> hashes_;  // of each state
  std::vector<StateId> table_;         // its size is a power of two
};

}  // namespace lockstep::host

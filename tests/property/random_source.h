// What random trees are drawn from: the same seed, the same tree.
#pragma once

#include <cstdint>

#include "base/core/random.h"

namespace lockstep::host::test {

class RandomSource {
 public:
  explicit RandomSource(std::uint64_t seed) : random_(seed, 0) {}

  int between(int low, int high) {
    return low + static_cast<int>(random_.next() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool one_in(int count) { return between(1, count) == 1; }
  template <class List>
  auto pick(const List& list) {
    return list[static_cast<std::size_t>(between(0, static_cast<int>(list.size()) - 1))];
  }

 private:
  RandomStream random_;
};

}  // namespace lockstep::host::test

// Sets of numbers that become one.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace lockstep::host {

class UnionFind {
 public:
  explicit UnionFind(std::size_t size) : parents_(size) {
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t it) {
    for (; parents_[it] != it; it = parents_[it]) parents_[it] = parents_[parents_[it]];
    return it;
  }
  void unite(std::size_t one, std::size_t other) { parents_[find(one)] = find(other); }

 private:
  std::vector<std::size_t> parents_;
};

}  // namespace lockstep::host

// The leaves of a model ask which of several things they do. The answers decide what a run is.
#pragma once

#include <cstdint>

namespace lockstep::host {

class Answers {
 public:
  virtual ~Answers() = default;
  // From 0 to `count` - 1; `count` is at least 1. `asker` is a leaf by its number, or behind the
  // leaves a fact.
  virtual std::uint32_t choose(std::uint32_t count, std::uint32_t asker) = 0;
};

}  // namespace lockstep::host

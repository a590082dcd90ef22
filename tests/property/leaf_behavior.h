// What leaves do for a reference interpreter, where it is not a script for each.
#pragma once

#include <cstdint>

#include "base/core/after_cut.h"
#include "base/core/status.h"

namespace lockstep::host::test {

class LeafBehavior {
 public:
  virtual ~LeafBehavior() = default;
  virtual void start(std::uint32_t leaf) = 0;
  virtual Status tick(std::uint32_t leaf) = 0;
  virtual void halt(std::uint32_t leaf) = 0;
  virtual void pause(std::uint32_t leaf) = 0;
  virtual void resume(std::uint32_t leaf) = 0;
  virtual double progress(std::uint32_t leaf) const = 0;
  // Its process was cut while it ran. What it does then; `has_ticked`: it got a tick since it was
  // cut before, or was not, so it may go on.
  virtual AfterCut cut(std::uint32_t /*leaf*/, bool /*has_ticked*/) {
    return AfterCut::StartsAgain;
  }
};

}  // namespace lockstep::host::test

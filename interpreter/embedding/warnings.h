// The warnings that a program gets about its run beside faults, with the lines that leaves log: the
// command prints the same while it runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "engine/ticker.h"
#include "engine/tree.h"
#include "leaves/plugin/contract/leaf_set.h"

namespace lockstep::host {

class Warnings {
 public:
  Warnings(const Tree& tree, LeafLog log);

  // After a tick or a halt: its faults that the run goes on after, and each leaf whose progress was
  // found to be no share, or to rise while the leaf was held.
  void tell(const Ticker& ticker, std::span<const Fault> faults, std::uint64_t tick);
  // The run is as new.
  void begin_again() { out_of_range_ = went_on_ = 0; }

 private:
  const Tree& tree_;
  const LeafLog log_;
  std::size_t out_of_range_ = 0, went_on_ = 0;  // leaves that were told
};

}  // namespace lockstep::host

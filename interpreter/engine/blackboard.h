// The entries that the nodes of one run share: a slot per key, resolved when the tree was compiled.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/tree.h"

namespace lockstep {

struct Entry {
  Value value;               // monostate: not written yet
  std::uint32_t writes = 0;  // how often it was written since the run began; it may wrap
};

struct Blackboard {
  explicit Blackboard(const Tree& tree) { reset(tree); }
  void reset(const Tree& tree) {
    entries.resize(tree.slots.size());
    for (std::size_t slot = 0; slot < entries.size(); ++slot) {
      entries[slot].value = tree.slots[slot].initial;
      entries[slot].writes = 0;
    }
  }

  std::vector<Entry> entries;
};

}  // namespace lockstep

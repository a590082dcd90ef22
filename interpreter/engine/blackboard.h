// The entries that the nodes of one run share: a slot per key, resolved when the tree was compiled.
#pragma once

#include <vector>

#include "core/entry.h"
#include "engine/tree.h"

namespace lockstep {

struct Blackboard {
  explicit Blackboard(const Tree& tree) { reset(tree); }
  void reset(const Tree& tree) {
    entries.resize(tree.slots.size());
    for (std::size_t slot = 0; slot < entries.size(); ++slot) {
      const Slot& it = tree.slots[slot];
      entries[slot] = {.value = it.initial,
                       .type = it.type,
                       .typing = it.typing,
                       .is_present = it.is_present,
                       .object = it.object};
    }
  }

  std::vector<Entry> entries;
};

}  // namespace lockstep

// The entries that leaves of one run share: a slot per key, resolved when the tree was compiled.
#pragma once

#include <vector>

#include "engine/tree.h"

namespace lockstep {

struct Blackboard {
  explicit Blackboard(const Tree& tree) { reset(tree); }
  void reset(const Tree& tree) {
    values.resize(tree.slots.size());
    for (std::size_t slot = 0; slot < values.size(); ++slot) {
      values[slot] = tree.slots[slot].initial;
    }
  }

  std::vector<Value> values;  // monostate: nobody has written it yet
};

}  // namespace lockstep

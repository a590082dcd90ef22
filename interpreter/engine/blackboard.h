// The entries that the nodes of one run share: a slot per key, resolved when the tree was compiled.
#pragma once

#include <vector>

#include "blackboard/entry.h"
#include "engine/tree.h"

namespace lockstep::host {

struct Blackboard {
  explicit Blackboard(const Tree& tree) { reset(tree); }
  void reset(const Tree& tree);

  std::vector<Entry> entries;
};

}  // namespace lockstep::host

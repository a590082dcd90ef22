// The part of a tree that decides whether its barriers open: their members and what is around
// these. Everything else is put together into leaves, so that the dry run of a large tree has
// little to do.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "tree/definition.h"

namespace lockstep::host {

struct DryNode {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  enum class Kind : std::uint8_t {
    Leaf,      // gains progress by itself, in small steps, and then succeeds
    Around,    // one child, whose progress it has
    Sequence,  // children one after the other
    All,       // children at a time; it succeeds when all have, and has the least progress
    Rounds,    // one child, several times
  };

  Kind kind;
  std::uint32_t node;    // in the definition
  std::uint32_t end;     // one past the last descendant, in the dry tree, which is in pre-order
  std::uint32_t parent;  // the root is its own
  std::uint32_t keeper = kNone;  // who may hold it, in DryTree::keepers
  // It adds this to the progress of its parent: (place + progress) / parts.
  double place = 0, parts = 1;
  // The rest is for leaves.
  double last = 1;       // the progress from which it jumps to 1
  bool at_once = false;  // it succeeds when it begins: nothing in it runs, or it is a guard
};

// A synchronized node, which holds its children, or a barrier, which holds the children of its
// SyncProgress nodes.
struct DryKeeper {
  std::uint32_t node;                             // in the definition
  const std::vector<double>* barriers = nullptr;  // null: it holds by `delta`
  double delta = 0;
  bool ticks_at_barrier = false;
  bool waits_for_idle = true;
  std::vector<std::uint32_t> kept = {};  // in the dry tree
};

struct DryTree {
  std::vector<DryNode> nodes;  // none: nothing waits at a barrier
  std::vector<DryKeeper> keepers;
};

// In doubt a member is waited for by nobody. So a node of which is not known that all of its
// children run, and that it succeeds when they do, is a leaf with all that is in it; and who has
// limits from an entry keeps nobody.
DryTree dry_tree(const Definition& definition);

}  // namespace lockstep::host

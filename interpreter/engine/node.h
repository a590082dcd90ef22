// A node of the compiled tree, as a tick sees it. engine/tree.h has the tree.
#pragma once

#include <cstdint>

#include "engine/node_kind.h"

namespace lockstep::host {

struct Node {
  const NodeKind* kind;
  NodeIndex end;                       // one past the last descendant
  std::uint32_t children : 27;         // how many; of a group: members
  std::uint32_t synchronizes : 2 = 0;  // Synchronization: see engine/synchronized.h
  std::uint32_t is_guard : 1;          // no action is in it: a parallel asks it in every tick
  std::uint32_t is_latched : 1;        // a parallel does not tick it again after it has completed
  // It has one activation at most in each of its parent. Only in trees with groups; false: unknown.
  std::uint32_t is_begun_once : 1 = 0;
  std::uint32_t params;  // first cell in Tree::cells; of a plugin leaf: its place in Tree::leaves
  std::uint32_t state;   // first byte in RunState's node states
};

// A typed parameter, in the order of the kind's parameter table.
union Cell {
  bool boolean;
  std::int64_t integer;  // also the index of a choice
  double number;
  struct {
    std::uint32_t first, count;  // in Tree::numbers; of texts, `integer` is one of Tree::constants
  } list;
};

}  // namespace lockstep::host

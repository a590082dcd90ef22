// Why the root completed as it did: the path from it to the node that decided. A leaf decides for
// itself, a Timeout whose time is over does too; any other node takes the result of a child, or
// turns it around.
#pragma once

#include <functional>
#include <vector>

#include "core/status.h"
#include "engine/tree.h"

namespace lockstep {

class Ticker;

struct DecidingNode {
  NodeIndex node = 0;
  Status status = Status::Idle;  // its result
  std::size_t children = 0;
  std::size_t agreeing = 0;  // how many of the children have the same result
};

// A tree after its last tick, that of a run or of a recording.
struct TickedTree {
  std::function<std::vector<NodeIndex>(NodeIndex node)> children;
  std::function<Status(NodeIndex node)> status;
  std::function<bool(NodeIndex node)> ticked;  // by that tick
};

// From the root down. Asks each node on the path for its children, no other.
std::vector<DecidingNode> deciding_path(const TickedTree& tree);
std::vector<DecidingNode> deciding_path(const Ticker& ticker);

}  // namespace lockstep

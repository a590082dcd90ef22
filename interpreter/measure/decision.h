// Why the root completed with its result: the path from the root to the node that decided. A leaf
// decides itself, and so does a Timeout whose time is over. Any other node takes the result of a
// child, or inverts it.
#pragma once

#include <functional>
#include <vector>

#include "core/status.h"
#include "engine/node_kind.h"

namespace lockstep::host {

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

// From the root down. Looks only at nodes on the path and their children.
std::vector<DecidingNode> deciding_path(const TickedTree& tree);
std::vector<DecidingNode> deciding_path(const Ticker& ticker);

}  // namespace lockstep::host

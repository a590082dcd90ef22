// Why the root completed with its result: the path from the root to the node that decided. A leaf
// decides itself, and so does a Timeout whose time is over. Any other node takes the result of a
// child, or inverts it.
#pragma once

#include <optional>
#include <vector>

#include "base/core/status.h"
#include "trace/moment.h"
#include "trace/shape.h"

namespace lockstep::host {

struct DecidingNode {
  NodeIndex node = 0;
  Status status = Status::Idle;  // its result
  std::size_t children = 0;
  std::size_t agreeing = 0;  // how many of the children have the same result
};

DecidingNode deciding_node(const Shape& shape, const Moment& moment, NodeIndex node);
// The child whose result a completed node has taken; none: it decided itself, or is not complete.
std::optional<NodeIndex> deciding_child(const Shape& shape, const Moment& moment, NodeIndex node);
// From the root down, after the last tick of a run.
std::vector<DecidingNode> deciding_path(const Shape& shape, const Moment& moment);

}  // namespace lockstep::host

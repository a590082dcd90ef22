// Finds which nodes wait for which where a synchronized node does not come on, from the Moment
// of a run that goes on. A link goes from what a node withholds ticks from to what that waits for.
// The next link is of the node that withholds ticks from this, or of one that waits for something
// in it. The links end in a circle, or where nobody withholds anything.
#pragma once

#include <vector>

#include "base/core/resource_set.h"
#include "base/core/status.h"
#include "judge/measure/hindrance.h"

namespace lockstep::host {

// A barrier and a pool call what they hold by their members.
struct WaitLink {
  NodeIndex node = 0;                     // a synchronized node, a barrier or a pool
  NodeIndex waiting = 0;                  // that it withholds ticks from
  NodeIndex awaited = 0;                  // until this has come; of a pool: an owner
  double waiting_at = 0, awaited_at = 0;  // progress, as the node uses it
  Status awaited_status = Status::Idle;
  ResourceSet resources = 0;  // of a pool: what both need
};

struct WaitChain {
  std::vector<WaitLink> links;
  Obstacle obstacle = Obstacle::Running;  // of what the last link waits for
};

// Whether a synchronized node that is no pool holds somebody back.
bool holds_somebody(const Shape& shape, const Moment& moment, NodeIndex node);

// From such a node on. If it only leads to a circle, that circle. A circle begins with its first
// node in the tree.
WaitChain wait_chain(const Shape& shape, const Moment& moment, NodeIndex node);
// The same from something that gets no ticks, such as a member of a pool.
WaitChain wait_chain(const Shape& shape, const Moment& moment, Withheld begin);

}  // namespace lockstep::host

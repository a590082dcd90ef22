// Texts for why a child of a synchronized node is held, for the views.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "base/core/node_type.h"

namespace lockstep::host {

// A synchronized node in one tick, of a tree that runs or of a recording.
struct WaitedAt {
  Synchronization synchronization = Synchronization::None;
  double limit = 0;                       // that counted: base/core/synchronization.h
  std::span<const double> progress = {};  // of each child, as the node used it
  std::function<std::string(std::size_t child)> name_of;
  std::string group = {};  // the name of a barrier beside the tree
  // Of children that stand for robots: why one cannot be relied on, or ""; and what was heard of it
  // last, or "".
  std::function<std::string(std::size_t child)> lost = {}, heard = {};
};

// "waits to begin together with base, of 'lift'": a member at a barrier at 0. `is_reached`: of the
// member of a number, whether it runs.
std::string beginning_text(const WaitedAt& node,
                           const std::function<bool(std::size_t child)>& is_reached);

// "waits for base at barrier 0.5" or "waits for base, 0.12 ahead (delta 0.1)", of a group with "of
// 'lift'". `child` is the number of the one that is held.
std::string waiting_text(const WaitedAt& node, std::size_t child);

// A pool in one tick. A member is known by its child's number.
struct OwnedFrom {
  std::span<const std::string> resources = {};
  std::size_t members = 0;
  std::function<double(std::size_t child)> limit;  // of the member: base/core/resource_set.h
  std::function<std::string(std::size_t child)> name_of;
  // Why the other robots do not give the member what it waits for; "" where none share the pool.
  std::function<std::string(std::size_t child)> why = {};
};

// "owns left;gripper", "waits for left (Plato/eat)", or "".
std::string ownership_text(const OwnedFrom& pool, std::size_t child);

}  // namespace lockstep::host

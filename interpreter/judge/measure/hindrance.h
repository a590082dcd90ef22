// Finds why a node does not come on, from the Moment of a run that goes on.
#pragma once

#include <cstdint>
#include <vector>

#include "trace/moment.h"
#include "trace/shape.h"

namespace lockstep::host {

// Something that gets no ticks. A barrier and a pool call it by their member.
struct Withheld {
  NodeIndex node;  // a synchronized node, a barrier or a pool
  NodeIndex from;  // its child or member
};

// Why a node does not come on if nobody withholds anything from it.
enum class Obstacle : std::uint8_t {
  Idle,     // it does not run
  Failed,   // and counts as 0
  Running,  // it gets ticks
  Denied,   // others own its resources
  Circle,   // it waits for itself
};

class Hindrance {
 public:
  Hindrance(const Shape& shape, const Moment& moment, NodeIndex node);

  // From the node, what it is inside of, what it lacks inside, or what runs before its turn.
  const std::vector<Withheld>& withheld() const { return withheld_; }
  // It can come no further than something in it that gets ticks.
  bool runs() const { return runs_; }
  // The synchronized nodes in it, and the barriers of members in it, on the way to that.
  const std::vector<NodeIndex>& passed() const { return passed_; }
  Obstacle obstacle() const { return obstacle_; }

 private:
  void look_at(NodeIndex node);
  void look_around(NodeIndex node);
  void look_inside(NodeIndex node);
  void look_before(NodeIndex node);
  void pass(NodeIndex node);
  bool lacks_resources(NodeIndex node) const;
  bool waits_to_begin(NodeIndex node) const;
  void add(NodeIndex member);
  void add_user(NodeIndex user);
  void add_gates(NodeIndex user);
  std::vector<NodeIndex> running_children(NodeIndex node) const;

  const Shape& shape_;
  const Moment& moment_;
  std::vector<Withheld> withheld_;
  std::vector<NodeIndex> passed_;
  bool runs_ = false;
  Obstacle obstacle_ = Obstacle::Running;
};

// The owners of the resources that a user of a pool is denied, which have them as long as they
// run: one with `keep`, and without an increment one before it in the tree. From all others it gets
// them in one of the next ticks.
std::vector<NodeIndex> lasting_owners(const Shape& shape, const Moment& moment, NodeIndex denied);

}  // namespace lockstep::host

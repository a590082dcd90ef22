// Leaves that go on while they are held: the progress of a leaf that gets no ticks rises. Nothing
// is broken by that, but what a barrier promises is not kept. Nodes that are not held cost nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "trace/faults.h"

namespace lockstep::host {

class NodeContext;

class HeldLeaves {
 public:
  explicit HeldLeaves(std::size_t leaves) { held_.reserve(leaves); }

  bool empty() const { return held_.empty(); }
  // From its pause on. Not of a leaf that was found already.
  void add(NodeContext& context, NodeIndex node);
  // Before a tick.
  void look(NodeContext& context);
  // In this run, one of each leaf.
  std::span<const WentOn> went_on() const { return went_on_; }
  void reset();

  struct Held {
    NodeIndex node;
    std::uint32_t rises;  // in how many ticks it has risen
    double from, most;
  };
  // All that it keeps, for who stores a run.
  template <class Self, class Visit>
  static void visit(Self& self, Visit&& visit) {
    visit(self.held_, self.went_on_);
  }

 private:
  bool is_done(NodeContext& context, Held& held);

  std::vector<Held> held_;
  std::vector<WentOn> went_on_;
};

// The progress that a leaf reports, if it reports a share. To look changes nothing: whoever needs
// the progress finds an error in it. Defined in nodes/leaf.cpp.
std::optional<double> look_at_progress(NodeContext& context, NodeIndex node);

}  // namespace lockstep::host

// Shows properties the Moments of a run or of a recording, in their order. Does not allocate after
// the first one, but for the text of an entry that is a long list.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "language/property/property_checks.h"
#include "trace/moment.h"
#include "trace/shape.h"

namespace lockstep::host {

PropertyNames property_names(const Shape& shape);

// Visits what properties see of a tick: its moments in their order, or the state after it. In a
// later moment of a tick `ticked` is what the tick has reached so far, so that its last moment is
// the state after the tick.
class MomentSteps {
 public:
  template <class Visit>  // (TickPart)
  void each(const Moment& moment, std::span<const std::uint32_t> nodes, std::span<SeenNode> seen,
            Visit visit) {
    if (column_.empty()) column_.resize(moment.activity.size());
    if (moment.within.empty()) [[likely]] {
      for (std::size_t i = 0; i < seen.size(); ++i) see(seen[i], moment.state(nodes[i]), true);
      return visit(TickPart{});
    }
    moment.within.each_part(column_,
                            [&](std::span<const NodeState> states, bool is_first, bool is_last) {
                              for (std::size_t i = 0; i < seen.size(); ++i)
                                see(seen[i], states[nodes[i]], is_first);
                              visit(TickPart{.is_first = is_first, .is_last = is_last});
                            });
  }

 private:
  static void see(SeenNode& seen, NodeState state, bool is_first) {
    seen.status = state.status();
    seen.ticked = state.ticked() || (!is_first && seen.ticked);
    seen.held = state.held();
  }
  std::vector<NodeState> column_;
};

class PropertySteps {
 public:
  // `checks` must outlive this.
  explicit PropertySteps(PropertyChecks& checks);

  // What the Moments of a run must have.
  AskedOfRun asked() const;
  // What PropertyChecks::step gives.
  std::span<const std::size_t> after_tick(const Moment& moment);

 private:
  PropertyChecks& checks_;
  MomentSteps steps_;
  std::vector<std::optional<std::uint32_t>> writes_;  // of the entry of each comparison
  std::string room_;
};

}  // namespace lockstep::host

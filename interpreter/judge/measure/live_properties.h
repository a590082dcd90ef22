// Shows properties the ticks of a run that a Ticker makes, exactly as a recording has them. Does
// not allocate after construction, but for the text of an entry that is a long list.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/moments.h"
#include "engine/tree.h"
#include "language/property/property_checks.h"
#include "trace/shape.h"

namespace lockstep::host {

class Ticker;

PropertyNames property_names(const Shape& shape);

// In a later moment of a tick `ticked` is what the tick has reached so far, so that its last moment
// is the state after the tick.
inline void see_node(SeenNode& seen, NodeState state, bool is_first = true) {
  seen.status = state.status();
  seen.ticked = state.ticked() || (!is_first && seen.ticked);
  seen.held = state.held();
}

class LiveProperties {
 public:
  // Both must outlive this.
  LiveProperties(const Tree& tree, PropertyChecks& checks);

  // Asks the nodes whose progress is compared for it.
  void before_tick(Ticker& ticker);
  // After the tick: what PropertyChecks::step gives.
  std::span<const std::size_t> after_tick(Ticker& ticker, std::uint64_t tick);

 private:
  // A place in PropertyChecks::seen, and who may have used the progress of its node.
  struct Used {
    std::size_t place;
    NodeIndex keeper;
    std::size_t child;  // its number there
  };

  PropertyChecks& checks_;
  std::vector<std::size_t> asked_;  // places in PropertyChecks::seen
  std::vector<Used> used_;
  std::vector<NodeState> moment_;
  std::vector<std::optional<std::uint32_t>> writes_;  // of the entry of each comparison
  std::string room_;
};

}  // namespace lockstep::host

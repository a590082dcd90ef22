// What `lockstep check` says of a tree after a short search of its behaviors. Its bound is a number
// of states and of ticks, so it says the same on every machine.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/core/diagnostics.h"
#include "base/core/place.h"
#include "engine/tree.h"

namespace lockstep::host {

struct Advice {
  MessageCode code;
  NodeIndex node;
  Severity severity;
  std::string message, hint;
};

enum class AdviceEffort : std::uint8_t {
  Run,        // deadlocks of leaves that come on in small steps and succeed
  Deadlocks,  // those of all behaviors too
  Certain,    // and what is certain whatever the leaves do, or unless one is skipped
};

// Nodes that no behavior ticks or ends: nothing of a tree that depends on more than its leaves
// (clocks, start values). And nodes that may wait for each other for ever, with leaves that do as
// their plugins declare. `places` are those of the nodes in their documents.
// Nothing if `stop_signal` is there and returns something else than 0: another thread wants no
// answer.
std::vector<Advice> advice_of(const Tree& tree, std::span<const Place> places,
                              AdviceEffort effort = AdviceEffort::Certain,
                              std::function<int()> stop_signal = {});

}  // namespace lockstep::host

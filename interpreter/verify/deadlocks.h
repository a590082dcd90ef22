// Deadlocks: from some state on, a synchronized node or a barrier holds a node in every tick,
// whatever the leaves do then. For example, `x` waits at a barrier for `y`, and `y` is inside of
// what another barrier holds until `x` comes.
#pragma once

#include <optional>
#include <vector>

#include "judge/measure/wait_chain.h"
#include "verify/search.h"

namespace lockstep::host {

struct Deadlock {
  WaitChain chain;
  NodeIndex decider = 0;  // if the last node that is waited for does not run: why it does not
};

// A member of a pool that waits for other resources while it keeps what it has.
bool exchanges(const Tree& tree, NodeIndex member);

// Each deadlock that the search has come to: the nearest ones first, those of the same nodes once.
// It need not be complete: a state counts only if all that can come after it is known.
std::vector<Deadlock> deadlocks(const Tree& tree, const LeafModels& models, double rate,
                                const SearchResult& found);

// Why a tree that never ends does not. Members of pools that wait for each other count as well.
struct NoEnd {
  std::optional<Deadlock> nearest;
  bool is_everywhere = false;  // each run comes to one, in which nobody waits for what runs
};
NoEnd why_no_end(const Tree& tree, const LeafModels& models, double rate,
                 const SearchResult& found);

}  // namespace lockstep::host

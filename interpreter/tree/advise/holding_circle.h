// Nodes that are held for ever because each waits for one that is held itself, or is inside of what
// is held, or comes after it in a Sequence. A dry run finds them: tree/advise/dry_run.h. It
// is no proof: leaves with large steps may pass, and what fails may let the others go.
#pragma once

#include <cstdint>
#include <vector>

#include "tree/definition.h"

namespace lockstep::host {

// Nodes of the definition.
struct HoldingLink {
  std::uint32_t keeper;   // the synchronized node, or the barrier
  std::uint32_t held;     // its child, or the SyncProgress
  std::uint32_t awaited;  // another one, which is behind
  double limit;           // the progress at which `held` is held
  // The Sequence in which `awaited` has not begun, and the child at which that is; else both are
  // `awaited`.
  std::uint32_t sequence, before;
};

// The first circle that is found, or nothing. Of trees with barriers that are not refused.
std::vector<HoldingLink> holding_circle(const Definition& definition);

}  // namespace lockstep::host

// In words: why a child of a synchronized node is held, and who stands still. The console views and
// the command line say it the same way.
#pragma once

#include <span>
#include <string>

#include "engine/tree.h"
#include "measure/stall.h"

namespace lockstep {

// "waits for base at barrier 0.5" or "waits for base, 0.12 ahead (delta 0.1)". `progress` is that
// of all children of `node`, as the node used it; `child` is the number of the one that is held.
std::string waiting_text(const Tree& tree, NodeIndex node, std::span<const double> progress,
                         std::size_t child);

// "Door/pull/base stands still at 0.31 since 2.4 s and holds the other children of 'pull' back".
std::string standstill_text(const Tree& tree, const Standstill& standstill);

}  // namespace lockstep

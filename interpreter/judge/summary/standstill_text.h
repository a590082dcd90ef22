// A standstill in words: a line that says what it is, then one for each link that leads to it.
#pragma once

#include <string>
#include <vector>

#include "judge/measure/stall.h"

namespace lockstep::host {

// "a circle stands still since 0.100 s: coarse -> fine -> coarse", then for each node
// "'coarse' holds 'c2' at 0.5 until 'c1' comes, which is at 0.25 and has 'f1' in it"; or
// "Door/pull/base stands still at 0.31 since 2.4 s and holds the other children of 'pull' back".
std::vector<std::string> standstill_lines(const Shape& shape, const Standstill& standstill);

// Only the lines of the links, each of which says who is held and what that waits for.
std::vector<std::string> wait_lines(const Shape& shape, const WaitChain& chain);

// "circle", "idle", "failed", "resources" or "running": why it stands.
std::string_view to_string(Obstacle obstacle);

}  // namespace lockstep::host

// verify="yes": all behaviors that the leaf file allows, instead of one.
#pragma once

#include <functional>
#include <vector>

#include "scenario/performance.h"

namespace lockstep::host {

// A surprise for each finding, and for each property that does not hold.
std::vector<Surprise> verify_scenario(const Rehearsal& rehearsal, const Stage& stage,
                                      const LeafFile* file,
                                      const std::function<int()>& stop_signal);

}  // namespace lockstep::host

// verify="yes": all behaviors that the leaf file allows, instead of one.
#pragma once

#include <functional>
#include <vector>

#include "scenario/scenario_runner.h"

namespace lockstep::host {

// A surprise for each finding, and for each property that does not hold.
std::vector<Surprise> verify_scenario(const BoundScenario& bound, const Fixture& fixture,
                                      const LeafFile* file,
                                      const std::function<int()>& stop_signal);

}  // namespace lockstep::host

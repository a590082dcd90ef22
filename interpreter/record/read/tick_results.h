// What nodes returned within a tick of several moments, which the state after it does not tell.
#pragma once

#include <string>
#include <vector>

#include "record/recording.h"

namespace lockstep::host {

// Of each node its results, in their order: "failure, 2 times success". Empty: the tick has one
// moment.
std::vector<std::string> results_within(const RecordedTick& tick);

}  // namespace lockstep::host

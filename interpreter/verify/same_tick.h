// Whether a tick of one run did the same as a tick of another one.
#pragma once

#include <string>

#include "engine/ticker.h"

namespace lockstep::host {

// "" or the first difference: "'T/a' is held; in the search, it is running". What is below a node
// that has ended does not count.
std::string difference(const Ticker& run, const Ticker& in_search);

}  // namespace lockstep::host

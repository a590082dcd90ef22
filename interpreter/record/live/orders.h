// The orders of a client, as JSON: {"do":"step","ticks":1}.
#pragma once

#include <string>
#include <string_view>

#include "base/core/problem.h"
#include "run/run_control.h"
#include "trace/shape.h"

namespace lockstep::host {

// The order that the text has, checked: it can be carried out in a run of this tree.
Result<RunControl::Order> read_order(const Shape& shape, bool is_real_time, std::string text);

// The refusal of `attend` in a run without --attended.
Problem vain_attendance();

// When the run is to pause, as clients say it: "begins", "completes", "barrier", "succeeds" or
// "fails".
std::string_view word_of(Breakpoint::When when);

}  // namespace lockstep::host

// Sentences about a leaf whose progress is not as it should be, or whose call takes long. Used by
// all that tell it.
#pragma once

#include <string>

#include "base/system/call_mark.h"

namespace lockstep::host {

// "reported the progress 37: progress is a share from 0 to 1, so it counts as 1".
std::string out_of_range_text(double reported);
// "went on while it was held: its progress rose from 0.25 to 0.27".
std::string went_on_text(double from, double to);

// "heard at 0.24, 0.02 s ago": a robot's progress as another one knows it.
std::string heard_text(double progress, Nanoseconds age);

// "took 3.100 ms in tick, more than the budget of 1.000 ms".
std::string over_budget_text(PluginFunction function, Nanoseconds took, Nanoseconds budget);

}  // namespace lockstep::host

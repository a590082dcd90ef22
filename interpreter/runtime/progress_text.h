// What is said of a leaf whose progress is not as it should be. Used by all that tell it.
#pragma once

#include <string>

namespace lockstep::host {

// "reported the progress 37: progress is a share from 0 to 1, so it counts as 1".
std::string out_of_range_text(double reported);
// "went on while it was held: its progress rose from 0.25 to 0.27".
std::string went_on_text(double from, double to);

}  // namespace lockstep::host

// How a leaf is named whose progress is no share. Used by all that tell it.
#pragma once

#include <string>

namespace lockstep {

// "reported the progress 37: progress is a share from 0 to 1, so it counts as 1".
std::string out_of_range_text(double reported);

}  // namespace lockstep

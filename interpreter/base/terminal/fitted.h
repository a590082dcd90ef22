// Text of whole lines in a terminal that is narrower than some of them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lockstep::host {

// Each line that needs more than `width` columns goes on at a blank, below and further to the right
// than it begins. A word that is longer stays whole. Colors need no columns.
std::string fitted(std::string_view text, std::size_t width);

}  // namespace lockstep::host

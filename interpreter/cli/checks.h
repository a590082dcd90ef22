// What CLI11 lets pass on a command line and should not: for ->check(). They return "" or what is
// wrong.
#pragma once

#include <string>

namespace lockstep {

// CLI11 reads -1, and what is larger than 64 bits hold, as the largest number there is.
std::string check_count(const std::string& text);

// CLI::Range takes nan for a number of its range.
std::string check_is_number(const std::string& text);

}  // namespace lockstep

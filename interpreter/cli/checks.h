// What CLI11 lets pass on a command line and should not. The checks return "" or what is wrong.
#pragma once

#include <string>

namespace CLI {
class Validator;
}

namespace lockstep {

// A whole number of 64 bits.
std::string check_count(const std::string& text);

// For ->transform(): such a number, at least 0 or 1. CLI11 reads -1, and what is larger than 64
// bits hold, as the largest number there is, and 010 as 8.
enum class Least : bool { Zero, One };
CLI::Validator whole_number(Least least = Least::Zero);

// CLI::Range takes nan for a number of its range.
std::string check_is_number(const std::string& text);

}  // namespace lockstep

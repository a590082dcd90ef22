// What the values of options may be, in words of ours. CLI11 reads -1, and what is larger than 64
// bits hold, as the largest number there is, 010 as 8, and takes nan for a number of any range.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace CLI {
class Validator;
}

namespace lockstep {

// "", or what is wrong with it as a whole number of 64 bits.
std::string check_count(const std::string& text);

// For ->transform().
CLI::Validator whole_number(std::uint64_t least = 0,
                            std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

// For ->check().
CLI::Validator number_between(double least, double most);
CLI::Validator one_of(const std::vector<std::string>& words);

}  // namespace lockstep

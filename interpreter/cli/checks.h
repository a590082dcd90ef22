// Checks the values of options, with our own messages. CLI11 reads -1 and numbers of more than 64
// bits as the largest number, 010 as 8, and accepts nan for any range.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class Validator;
}

namespace lockstep::host {

// "", or the error in it as a whole number of 64 bits.
std::string check_count(const std::string& text);

// For ->transform().
CLI::Validator whole_number(std::uint64_t least = 0,
                            std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

// For ->check().
CLI::Validator number_between(double least, double most);
// A word that there is no more, and what to take instead.
struct FormerWord {
  std::string_view word, instead;
};
CLI::Validator one_of(const std::vector<std::string>& words, FormerWord former = {});

}  // namespace lockstep::host

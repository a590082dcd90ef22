// Which trials of a test of random trees: so many, from a first seed. ./dev property sets these
// variables.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>

namespace lockstep::host::test {

struct Seeds {
  std::uint64_t first, count;
};

inline Seeds seeds(std::uint64_t first, std::uint64_t count) {
  const char* const its_first = std::getenv("LOCKSTEP_PROPERTY_SEED");
  const char* const its_count = std::getenv("LOCKSTEP_PROPERTY_TREES");
  return {its_first == nullptr ? first : std::stoull(its_first),
          its_count == nullptr ? count : std::stoull(its_count)};
}

}  // namespace lockstep::host::test

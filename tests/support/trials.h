// How many random trials a test with the tag [trials] has: so many in ./dev test, and
// LOCKSTEP_TRIALS times as many in
// ./dev nightly.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>

namespace lockstep::host::test {

inline std::uint64_t trials(std::uint64_t count) {
  const char* const times = std::getenv("LOCKSTEP_TRIALS");
  return times == nullptr ? count : count * std::stoull(times);
}

}  // namespace lockstep::host::test

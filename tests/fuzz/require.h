// Ends a fuzz target where a law does not hold.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace lockstep::host::fuzz {

inline void require(bool holds, const char* law = "see the stack") {
  if (holds) return;
  std::fprintf(stderr, "broken law: %s\n", law);
  std::abort();
}

}  // namespace lockstep::host::fuzz

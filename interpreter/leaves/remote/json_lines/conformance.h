// Whether a program keeps the protocol: asks each of its leaves all that a run could ask.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "leaves/remote/isolation_options.h"

namespace lockstep::host {

struct ConformanceStep {
  bool is_good = false;
  std::string text;
};

struct Conformance {
  std::vector<ConformanceStep> steps;
  std::string first_line;   // of the program; "" without
  bool has_started = true;  // else nothing is known about it
  bool is_good() const { return std::ranges::all_of(steps, &ConformanceStep::is_good); }
};

// Begin: it is started and says what leaves it has, but none of them is made, so that nothing
// moves.
enum class ConformancePart { Begin, All };

Conformance check_conformance(const std::string& path, const IsolationOptions& options,
                              ConformancePart part);

}  // namespace lockstep::host

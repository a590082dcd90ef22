// Whether a program keeps the protocol: asks each of its leaves all that a run could ask.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "remote/isolation_options.h"

namespace lockstep::host {

struct ConformanceStep {
  bool is_good = false;
  std::string text;
};

struct Conformance {
  std::vector<ConformanceStep> steps;
  std::string first_line;  // of the program; "" without
  bool is_good() const { return std::ranges::all_of(steps, &ConformanceStep::is_good); }
};

Conformance check_conformance(const std::string& path, const IsolationOptions& options);

}  // namespace lockstep::host

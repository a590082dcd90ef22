// `lockstep verify` of the trees of several robots: `left.xml right.xml`.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/load/load_options.h"
#include "verify/search_limits.h"

namespace lockstep::host {

struct TeamVerifyOptions {
  LoadCommandOptions load;
  std::vector<std::string> robots;  // FILE[,ARGUMENT=VALUE...]
  std::string leaves;               // of all robots; "": none
  std::optional<double> rate;
  std::uint32_t late = 0;
  SearchLimits limits;
  std::function<void()> search_ended;
  std::string out;
  bool json = false;
};

// An exit code.
int verify_team(const TeamVerifyOptions& options);

}  // namespace lockstep::host

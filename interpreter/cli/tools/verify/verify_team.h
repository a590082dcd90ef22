// `lockstep verify` of the trees of several robots: `left.xml right.xml`.
#pragma once

#include <functional>
#include <string>

#include "cli/tools/team/robot_files.h"
#include "verify/search_limits.h"

namespace lockstep::host {

struct TeamVerifyOptions {
  TeamFiles files;
  std::uint32_t late = 0;
  SearchLimits limits;
  std::function<void()> search_ended;
  std::string out;
  bool json = false;
};

// An exit code.
int verify_team(const TeamVerifyOptions& options);

}  // namespace lockstep::host

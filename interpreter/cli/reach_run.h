// Runs of this user on this machine that other commands reach through their sockets.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/core/problem.h"

namespace lockstep::host {

// The request for the questions that a run asks at this moment. The answer is a JSON array.
inline constexpr std::string_view kListQuestions = R"({"do":"questions"})";

struct ReachableRun {
  std::string socket;
  std::string name;  // its process, or the socket
};

// `run` is the number of a process, the path of a socket, or "": any. Empty: there is none.
std::vector<ReachableRun> reachable_runs(const std::string& run);

// The name of this user.
std::string user_name();

}  // namespace lockstep::host

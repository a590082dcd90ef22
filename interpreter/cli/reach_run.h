// Runs of this user on this machine that other commands reach through their sockets.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/problem.h"

namespace lockstep::host {

// The request for the questions that a run asks at this moment. The answer is JSON.
inline constexpr std::string_view kListQuestions = R"({"do":"questions"})";

// The request for the answer that counted, to what a node asked in a tick: {"answer":…,"who":…},
// or {}.
struct AnsweredQuestion {
  std::uint32_t node = 0;
  std::uint64_t tick = 0;

  std::string request() const;
};
// Nothing: the request is another one.
std::optional<AnsweredQuestion> answered_question(const std::string& request);

struct ReachableRun {
  std::string socket;
  std::string name;  // its process, or the socket
};

// `run` is the number of a process, the path of a socket, or "": any. Empty: there is none.
std::vector<ReachableRun> reachable_runs(const std::string& run);

// The name of this user.
std::string user_name();

}  // namespace lockstep::host

// A team over a network. What speaks with it is a module of its own, which a tree without a team
// does not load.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/core/problem.h"
#include "team/transport.h"

namespace lockstep::host {

struct TeamNetworkOptions {
  std::uint32_t domain = 0;        // those of another one hear nothing of this
  std::vector<std::string> peers;  // addresses or names; none: multicast finds them
  std::string interface;           // "": the system chooses
  // Called from another thread: what a person should know, once each.
  std::function<void(const std::string& line)> tell = {};
};

// `module`: its file. A refusal says why there is no network. Received words have the time of
// CLOCK_MONOTONIC.
Result<std::unique_ptr<TeamTransport>> open_team_network(const std::string& module,
                                                         std::span<const TeamDeclaration> teams,
                                                         const TeamNetworkOptions& options);

// What the module has under the name `lockstep_open_team`: null, and a sentence in `why`.
using OpenTeam = TeamTransport* (*)(std::span<const TeamDeclaration> teams,
                                    const TeamNetworkOptions& options, std::string& why);

}  // namespace lockstep::host

// `run` of a tree with a team: the robots that it is in step with, over the network.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "cli/run/run_options.h"
#include "team/network.h"
#include "team/team_run.h"

namespace lockstep::host {

class ConnectedTeam {
 public:
  // A random number of the process.
  static std::uint64_t random_run();
  // Null: the tree is in no team. `run` is a random number. `tell` may be called from any thread.
  static Result<std::unique_ptr<ConnectedTeam>> open(
      const RunCommandOptions& options, const Tree& tree, std::uint64_t run,
      std::function<void(const std::string& line)> tell);

  TeamRun& run() { return *run_; }

 private:
  ConnectedTeam() = default;

  WallClock clock_;  // silence is that of the network, on whatever clock the tree is ticked
  std::unique_ptr<TeamTransport> transport_;
  std::unique_ptr<TeamRun> run_;
};

}  // namespace lockstep::host

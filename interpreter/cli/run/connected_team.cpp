#include "cli/run/connected_team.h"

#include <algorithm>
#include <random>

#include "run/loading/plugins.h"

namespace lockstep::host {

std::uint64_t ConnectedTeam::random_run() {
  std::random_device random;
  return std::uint64_t{random()} << 32u | random();
}

Result<std::unique_ptr<ConnectedTeam>> ConnectedTeam::open(
    const RunCommandOptions& options, const Tree& tree, std::uint64_t run,
    std::function<void(const std::string& line)> tell) {
  // Leaves that are played stand for the other robots, too.
  const auto teams = options.leaves.empty() ? teams_of(tree, from_seconds(1 / options.rate))
                                            : std::vector<TeamDeclaration>();
  if (teams.empty()) return nullptr;
  if (!options.is_real()) {
    return tl::unexpected(Problem{"--clock virtual: the other robots of the team have another time",
                                  "`lockstep team` simulates all of them"});
  }
  if (const auto why_not = why_not_kept(tree); why_not && !options.keep.file.empty())
    return tl::unexpected(Problem{"--checkpoint: " + why_not->message, why_not->hint});
  std::unique_ptr<ConnectedTeam> team(new ConnectedTeam);
  TeamNetworkOptions network = options.team;
  network.tell = std::move(tell);
  auto transport = open_team_network(team_module(options.load.plugins), teams, network);
  if (!transport) return tl::unexpected(transport.error());
  team->transport_ = std::move(*transport);
  team->run_ = std::make_unique<TeamRun>(tree, teams, run, *team->transport_, team->clock_);
  return team;
}

}  // namespace lockstep::host

// The robots of a team as a command takes them: a tree file of each, with arguments of its own.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/load/load_options.h"
#include "team/member.h"

namespace lockstep::host {

struct LoadedRobot {
  std::string file;
  Loaded loaded;
};
// Of "carry.xml,me=left". Otherwise an exit code; what is wrong is reported.
tl::expected<LoadedRobot, int> load_robot(const std::string& text, LoadCommandOptions load,
                                          std::shared_ptr<PluginSet> plugins);

// The teams of one robot, and the file that declares them.
using TeamsOfRobot = std::vector<TeamDeclaration>;
// An exit code: no robot is without a team, and no two have one name. It notes who is missing: the
// others wait for them.
int check_teams(std::span<const TeamsOfRobot> robots, std::span<const std::string> files);

}  // namespace lockstep::host

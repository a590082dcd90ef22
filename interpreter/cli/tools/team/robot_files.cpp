#include "cli/tools/team/robot_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/core/wording.h"
#include "cli/console.h"
#include "cli/exit_code.h"

namespace lockstep::host {

tl::expected<LoadedRobot, int> load_robot(const std::string& text, LoadCommandOptions load,
                                          std::shared_ptr<PluginSet> plugins) {
  const auto comma = text.find(',');
  const std::string file = text.substr(0, comma);
  for (auto at = comma; at != std::string::npos;) {
    const auto next = text.find(',', at + 1);
    load.arguments.push_back(text.substr(at + 1, next - at - 1));
    at = next;
  }
  Diagnostics diagnostics;
  auto loaded = load_given(file, load, diagnostics, std::move(plugins));
  print_diagnostics(diagnostics, Severity::Warning);
  if (!loaded) return tl::unexpected(exit_code_of(loaded.error()));
  return LoadedRobot{file, std::move(*loaded)};
}

namespace {

bool is_member(const TeamsOfRobot& robot, const std::string& team, const std::string& name) {
  return std::ranges::any_of(
      robot, [&](const TeamDeclaration& it) { return it.team == team && it.self == name; });
}

void note_missing(std::span<const TeamsOfRobot> robots) {
  std::set<std::string> told;
  for (const TeamsOfRobot& robot : robots) {
    for (const TeamDeclaration& team : robot) {
      for (const std::string& name : team.others) {
        const bool is_there = std::ranges::any_of(
            robots, [&](const auto& other) { return is_member(other, team.team, name); });
        if (is_there || !told.insert(team.team + '/' + name).second) continue;
        print_note(fmt::format("no file is '{}' of the team '{}', so the others wait for it",
                               printable(name), printable(team.team)));
      }
    }
  }
}

}  // namespace

int check_teams(std::span<const TeamsOfRobot> robots, std::span<const std::string> files) {
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (!robots[i].empty()) continue;
    print_error(fmt::format("{}: its tree is in no team", printable(files[i])),
                "declare one: <team name=\"…\" members=\"…\"/>, and an InStep that names it");
    return kExitInvalidTree;
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      for (const TeamDeclaration& it : robots[i]) {
        if (!is_member(robots[k], it.team, it.self)) continue;
        print_error(fmt::format("two robots are '{}'", printable(it.self)),
                    "give each its argument, such as carry.xml,me=left carry.xml,me=right");
        return kExitUsage;
      }
    }
  }
  note_missing(robots);
  return kExitSuccess;
}

}  // namespace lockstep::host

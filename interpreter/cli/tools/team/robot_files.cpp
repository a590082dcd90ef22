#include "cli/tools/team/robot_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/core/wording.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/told.h"
#include "cli/tools/verify/verify_input.h"
#include "team/team_run.h"
#include "tree/pace.h"
#include "verify/verifiable.h"

namespace lockstep::host {
namespace {

// "carry.xml,me=left"; but the name of a file may have a comma.
std::string take_arguments(const std::string& text, std::vector<std::string>& arguments) {
  std::error_code none;
  const bool is_file = std::filesystem::is_regular_file(text, none);
  const auto comma = is_file ? std::string::npos : text.find(',');
  for (auto at = comma; at != std::string::npos;) {
    const auto next = text.find(',', at + 1);
    arguments.push_back(text.substr(at + 1, next - at - 1));
    at = next;
  }
  return text.substr(0, comma);
}

bool is_member(const RobotOfTeam& robot, const std::string& team, const std::string& name) {
  return std::ranges::any_of(
      robot.teams, [&](const TeamDeclaration& it) { return it.team == team && it.self == name; });
}

// A search cannot know what an entry has in a robot that asks for it.
void add_problems(const Tree& tree, std::vector<NodeProblem>& problems) {
  for (const RobotLeaf& it : robot_leaves(tree)) {
    if (!it.asks || it.wanted) continue;
    problems.push_back({tree.labels[tree.leaves[it.leaf].node].parent,
                        "an entry names the shared resources that it uses, so robots cannot be "
                        "verified together",
                        "name them here"});
  }
}

bool is_at(const Diagnostic& one, const Diagnostic& other) {
  return one.code.text() == other.code.text() && one.location.file == other.location.file &&
         one.location.line == other.location.line && one.location.column == other.location.column;
}

// Whether there are errors. A row of the leaf model need not fit all robots.
bool report(const std::vector<Diagnostics>& said, Told& told) {
  const auto is_said_by_all = [&](const Diagnostic& wanted) {
    return std::ranges::all_of(said, [&](const Diagnostics& all) {
      return std::ranges::any_of(all.all(),
                                 [&](const Diagnostic& it) { return is_at(it, wanted); });
    });
  };
  bool has_errors = false;
  for (std::size_t i = 0; i < said.size(); ++i) {
    Diagnostics kept;
    for (const Diagnostic& it : said[i].all()) {
      const bool is_of_row = it.code.text() == "unknown-leaf";
      if (!is_of_row || (i == 0 && is_said_by_all(it))) kept.add(it);
    }
    has_errors |= kept.has_errors();
    Diagnostics fresh = told.only_new(kept);
    print_diagnostics(fresh, Severity::Warning);
  }
  return has_errors;
}

}  // namespace

int TeamOfRobots::load(const TeamFiles& files) {
  std::unique_ptr<LeafFile> model;
  if (!files.leaves.empty()) {
    Diagnostics diagnostics;
    std::string text;
    auto read = read_leaves(files.leaves, text, diagnostics);
    print_diagnostics(diagnostics, Severity::Warning);
    if (!read || diagnostics.has_errors()) return kExitInvalidTree;
    model = std::move(*read);
  }
  rate_ = model != nullptr ? model->rate.value_or(files.usual_rate) : files.usual_rate;
  rate_ = files.rate.value_or(rate_);
  std::vector<Diagnostics> said(files.robots.size());
  Told told;
  for (std::size_t i = 0; i < files.robots.size(); ++i) {
    RobotOfTeam& robot = robots_.emplace_back();
    LoadCommandOptions load = files.load;
    robot.file = take_arguments(files.robots[i], load.arguments);
    Diagnostics diagnostics;
    auto loaded = load_given(robot.file, load, diagnostics);
    Diagnostics fresh = told.only_new(diagnostics);
    print_diagnostics(fresh, Severity::Warning);
    if (!loaded) return exit_code_of(loaded.error());
    if (model != nullptr || files.is_searched) {
      use_model(robot, std::move(*loaded), model.get(), files.is_searched, said[i]);
    } else {
      robot.runnable = make_runnable(std::move(*loaded));
    }
    robot.teams = teams_of(robot.runnable.tree, from_seconds(1 / rate_));
  }
  if (report(said, told)) return kExitInvalidTree;
  const int wrong = check();
  if (wrong == kExitSuccess) label();
  return wrong;
}

void TeamOfRobots::label() {
  for (RobotOfTeam& it : robots_) {
    const TeamDeclaration& team = it.teams.front();
    const auto count = std::ranges::count_if(
        robots_, [&](const RobotOfTeam& other) { return other.teams.front().self == team.self; });
    it.label = count > 1 ? team.team + '.' + team.self : team.self;
  }
}

void TeamOfRobots::use_model(RobotOfTeam& robot, Loaded loaded, const LeafFile* file,
                             bool is_searched, Diagnostics& said) {
  const Places places(loaded);
  robot.played.take_over(loaded.definition, stands_for_robots);
  robot.paces = paces(loaded.definition);
  ignore_pace(loaded.definition);
  robot.runnable = make_runnable(std::move(loaded));
  const Tree& tree = robot.runnable.tree;
  std::vector<NodeProblem> problems;
  Observed observed;
  if (is_searched) {
    problems = not_verifiable(tree);
    add_problems(tree, problems);
    observed = observed_by(tree, robot.runnable.properties, problems);
  }
  robot.models = make_models(tree, file, said, problems, observed);
  places.report(problems, said);
}

int TeamOfRobots::check() const {
  for (const RobotOfTeam& it : robots_) {
    if (!it.teams.empty()) continue;
    print_error(fmt::format("{}: its tree is in no team", printable(it.file)),
                "declare one: <team name=\"…\" members=\"…\"/>, and an InStep that names it");
    return kExitInvalidTree;
  }
  std::set<std::string> told;
  for (const RobotOfTeam& robot : robots_) {
    for (const TeamDeclaration& team : robot.teams) {
      const auto count = std::ranges::count_if(
          robots_, [&](const RobotOfTeam& it) { return is_member(it, team.team, team.self); });
      if (count > 1) {
        print_error(fmt::format("two robots are '{}'", printable(team.self)),
                    "give each its argument, such as carry.xml,me=left carry.xml,me=right");
        return kExitUsage;
      }
      for (const std::string& name : team.others) {
        const bool is_there = std::ranges::any_of(
            robots_, [&](const RobotOfTeam& it) { return is_member(it, team.team, name); });
        if (is_there || !told.insert(team.team + '/' + name).second) continue;
        print_note(fmt::format("no file is '{}' of the team '{}', so the others wait for it",
                               printable(name), printable(team.team)));
      }
    }
  }
  return kExitSuccess;
}

}  // namespace lockstep::host

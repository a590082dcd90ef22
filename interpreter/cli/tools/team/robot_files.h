// The robots of a team as a command takes them: the tree file of each, with the arguments for that
// robot, and a leaf model of all.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "cli/load/load_options.h"
#include "leaves/models.h"
#include "leaves/play/played_leaves.h"
#include "team/member.h"

namespace lockstep::host {

struct RobotOfTeam {
  std::string file = {};  // of its tree
  Runnable runnable = {};
  std::vector<TeamDeclaration> teams = {};  // at least one
  // With a leaf model: its leaves, but those that stand for other robots.
  PlayedLeaves played = {};
  LeafModels models = {};
  bool paces = false;

  std::string label = {};  // its name; with its team, if others have that too
};

struct TeamFiles {
  LoadCommandOptions load = {};
  std::vector<std::string> robots = {};  // FILE[,ARGUMENT=VALUE...]
  std::string leaves = {};               // a leaf model for all of them; "": none
  std::optional<double> rate = {};       // nothing: that of the leaf model, or the usual one
  double usual_rate = kModelRate;
  bool is_searched = false;  // needs a leaf model, and what a search can know
};

class TeamOfRobots {
 public:
  // An exit code; what is wrong is reported: a robot that is in no team, two with one name.
  int load(const TeamFiles& files);

  std::deque<RobotOfTeam>& robots() { return robots_; }
  const std::deque<RobotOfTeam>& robots() const { return robots_; }
  double rate() const { return rate_; }

 private:
  static void use_model(RobotOfTeam& robot, Loaded loaded, const LeafFile* file, bool is_searched,
                        Diagnostics& said);
  int check() const;
  void label();

  std::deque<RobotOfTeam> robots_;
  double rate_ = kModelRate;
};

}  // namespace lockstep::host

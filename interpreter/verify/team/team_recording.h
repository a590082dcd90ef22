// A run of a team that a search has found, as a recording of each robot: its tree ticked by a real
// run, with scripts of its leaves, and the words of the others as the search has delivered them.
#pragma once

#include <string>
#include <vector>

#include "leaves/play/played_leaves.h"
#include "run/loading/load.h"
#include "verify/team/team_search.h"

namespace lockstep::host {

struct RecordedRobot {
  std::string file, path;  // of its tree, and of the recording; "": it does not begin
  const Runnable& runnable;
  PlayedLeaves& played;  // the leaves of the tree
};

// Nothing: each tick did what it does in the search. Otherwise the difference, which is a bug in
// lockstep. An error: a file cannot be written.
Result<std::string> record_team(TeamSearch& search, const TeamFinding& finding,
                                const std::vector<TeamTree>& trees,
                                const std::vector<RecordedRobot>& robots, double rate);

}  // namespace lockstep::host

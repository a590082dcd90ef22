// One recording of a team, from one of each robot: a root, below it a node for each robot with its
// tree, on one clock. Ticks of several robots that begin within half a period are one tick of it.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "record/read/recording_reader.h"
#include "record/use/team_clocks.h"

namespace lockstep::host {

struct RobotRecording {
  RecordingReader* reader = nullptr;  // at its first tick
  std::string name;                   // differs from all others
  bool is_followed = false;           // by another run of the same member, whose end counts
  // Of each process of the run, which may have been cut and continued. `began` is at least 0: on
  // the clock of the result.
  std::vector<ClockFit> clocks = {};
};

// Whether it is such a recording already.
bool is_merged(const Shape& shape);

// The root is called `team`. Gives `write` whole lines, until it returns false, and then returns
// false. What is wrong with a recording its reader knows afterwards.
bool merge_recordings(const std::string& team, std::span<const RobotRecording> robots,
                      const std::function<bool(std::string_view)>& write);

}  // namespace lockstep::host

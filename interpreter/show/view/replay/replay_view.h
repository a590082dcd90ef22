// Draws a tick of a recording: the tree as in the live view of a run, and below it the position of
// the replay. Pure functions.
#pragma once

#include "show/view/replay/replay_player.h"
#include "show/view/tree_view.h"

namespace lockstep::host {

// `end`: of the run, when it ended with this tick; else null.
Snapshot snapshot_of(const RecordingHeader& header, const TimelineTick& moment,
                     const RecordedEnd* end);

// One tick as a whole: all nodes, then its faults, the entries that have changed, what leaves
// logged.
std::string draw_moment(const Shape& shape, const Snapshot& snapshot, const TimelineTick& moment,
                        const DrawOptions& options);

// At most height - 1 lines, as draw().
std::string draw_replay(const Shape& shape, const Snapshot& snapshot, const ReplayPlayer& player,
                        const DrawOptions& options);

}  // namespace lockstep::host

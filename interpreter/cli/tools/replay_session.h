// A replay on a terminal: passes keys and time to a ReplayPlayer and draws the result.
#pragma once

#include "record/read/recording_timeline.h"

namespace lockstep::host {

// stdin has the keys, stdout is the screen; both are a terminal. Until it is quit. Returns the exit
// code.
int play_on_terminal(const RecordingHeader& header, RecordingTimeline& timeline, double speed);

}  // namespace lockstep::host

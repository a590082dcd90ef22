// A recording as the log that BehaviorTree.CPP writes with FileLogger2, and Groot2 replays: the
// document of the tree, and the changes of the statuses of its nodes.
#pragma once

#include <functional>
#include <string_view>

#include "groot/tree.h"
#include "record/read/recording_reader.h"

namespace lockstep::host {

// Receives the next bytes; returns false to stop.
using GrootSink = std::function<bool(std::string_view bytes)>;

// `shown` is the tree of the recording. `start_time`: of the run, in seconds since 1970. Then check
// reader.error(). Returns false if the sink stopped it.
bool write_groot_log(RecordingReader& reader, const GrootTree& shown, double start_time,
                     const GrootSink& write);

}  // namespace lockstep::host

// The lines below a tree: blackboard entries, the latest changed first, and what leaves logged.
// Used by tree_view and replay_view.
#pragma once

#include <string>

#include "record/live/snapshot.h"
#include "show/view/tree_view.h"
#include "trace/shape.h"

namespace lockstep::host {

// At most `room` lines, and at most options.entries entries; the last line counts the others.
std::string entry_lines(const Shape& tree, const Snapshot& snapshot, const DrawOptions& options,
                        std::size_t room);

// The last lines that leaves logged: at most `room` and at most options.logs.
std::string log_lines(const Snapshot& snapshot, const DrawOptions& options, std::size_t room);

std::string log_line(const LeafLine& log, const DrawOptions& options);

}  // namespace lockstep::host

// Draws a tree and the state of its nodes as lines of text. A pure function: the live console calls
// it ten times a second, a replay for each frame, tests compare its text.
#pragma once

#include <string>

#include "record/live/snapshot.h"
#include "show/view/tree_layout.h"
#include "trace/shape.h"

namespace lockstep::host {

struct DrawOptions {
  unsigned width = 80, height = 24;
  bool color = false;
  bool unicode = false;
  bool keys = false;                   // keys work: mention them
  const Browsing* browsing = nullptr;  // null: nothing was chosen
  std::size_t entries = 5;             // at most so many of the blackboard below the tree
  std::size_t logs = 0;                // likewise lines that leaves logged
};

// The number of rows for nodes.
std::size_t rows_for_nodes(const DrawOptions& options);

// At most height - 1 lines of at most `width` columns, each ending in a newline. tree_layout.h says
// which nodes are shown when the tree has more. Entries and logs take the room that nodes leave.
std::string draw(const Shape& tree, const Snapshot& snapshot, const DrawOptions& options);

}  // namespace lockstep::host

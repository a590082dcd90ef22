// The nodes of a recording that compare progress, with the nodes whose progress they compare: their
// children, or the members of a barrier beside the tree.
#pragma once

#include <string>
#include <vector>

#include "record/recording.h"

namespace lockstep::host {

struct ComparedChildren {
  NodeIndex node = 0;
  std::vector<NodeIndex> children;
  std::vector<std::string> names = {};  // of them: no two are the same
};

std::vector<ComparedChildren> compared_children(const RecordingHeader& header);

}  // namespace lockstep::host

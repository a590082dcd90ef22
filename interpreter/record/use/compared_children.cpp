#include "record/use/compared_children.h"

namespace lockstep::host {
std::vector<ComparedChildren> compared_children(const RecordingHeader& header) {
  std::vector<ComparedChildren> all;
  for (NodeIndex node = 0; node < header.nodes.size(); ++node) {
    const ShapeNode& it = header.nodes[node];
    if (!compares_progress(it.synchronization)) continue;
    all.push_back({.node = node, .children = it.held(), .names = child_names(header, node)});
  }
  return all;
}

}  // namespace lockstep::host

#include "recording/use/compared_children.h"

namespace lockstep::host {

std::vector<ComparedChildren> compared_children(const RecordingHeader& header) {
  std::vector<ComparedChildren> all;
  std::vector<std::size_t> places(header.nodes.size(), SIZE_MAX);
  for (NodeIndex node = 0; node < header.nodes.size(); ++node) {
    const RecordedNode& it = header.nodes[node];
    if (it.parent && places[*it.parent] != SIZE_MAX) {
      all[places[*it.parent]].children.push_back(node);
    }
    const bool compares = it.synchronization == Synchronization::Absolute ||
                          it.synchronization == Synchronization::Relative;
    if (!compares) continue;
    places[node] = all.size();
    all.push_back({.node = node, .children = it.members});
  }
  return all;
}

}  // namespace lockstep::host

#include "recording/use/compared_children.h"

#include "measure/measure_spec.h"
#include "measure/synchronized_measure.h"

namespace lockstep::host {
namespace {

// Members of a barrier may have the same name, in different parts of the tree.
std::vector<std::string> names_in(const RecordingHeader& header, const ComparedChildren& compared) {
  const bool is_group = !header.nodes[compared.node].members.empty();
  std::vector<std::string> names;
  for (const NodeIndex child : compared.children) {
    const std::string& path = header.nodes[child].path;
    names.push_back(is_group ? path : last_segment(path));
  }
  return is_group ? names_of(names) : names;
}

}  // namespace

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
  for (ComparedChildren& it : all) it.names = names_in(header, it);
  return all;
}

}  // namespace lockstep::host

#include "engine/tree.h"

namespace lockstep {

std::string Tree::segment(NodeIndex node) const {
  const NodeLabel& label = labels[node];
  std::string segment(label.name);
  if (label.repeat != 0) segment.append("#").append(std::to_string(label.repeat));
  return segment;
}

std::string Tree::path(NodeIndex node) const {
  std::vector<NodeIndex> way{node};
  while (way.back() != labels[way.back()].parent) way.push_back(labels[way.back()].parent);
  std::string path = id;
  for (auto at = way.rbegin(); at != way.rend(); ++at) path.append("/").append(segment(*at));
  return path;
}

}  // namespace lockstep

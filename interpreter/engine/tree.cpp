#include "engine/tree.h"

namespace lockstep {

std::string Tree::path(NodeIndex node) const {
  std::vector<std::string_view> segments;
  for (NodeIndex at = node;; at = labels[at].parent) {
    segments.push_back(labels[at].segment);
    if (at == labels[at].parent) break;
  }
  std::string path = id;
  for (auto segment = segments.rbegin(); segment != segments.rend(); ++segment) {
    path.append("/").append(*segment);
  }
  return path;
}

}  // namespace lockstep

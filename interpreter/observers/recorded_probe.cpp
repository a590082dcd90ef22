#include "observers/recorded_probe.h"

#include <algorithm>

namespace lockstep {

std::vector<NodeIndex> synchronized_nodes(const RecordingHeader& header) {
  std::vector<NodeIndex> nodes;
  for (NodeIndex node = 0; node < header.nodes.size(); ++node) {
    if (header.nodes[node].synchronization != Synchronization::None) nodes.push_back(node);
  }
  return nodes;
}

RecordedProbe::RecordedProbe(const RecordingHeader& header, NodeIndex node)
    : node_(node), held_(0) {
  for (NodeIndex child = node + 1; child < header.nodes.size(); ++child) {
    if (header.nodes[child].parent < node) break;  // in pre-order: not below the node any more
    if (header.nodes[child].parent != node) continue;
    const std::string& path = header.nodes[child].path;
    children_.push_back(child);
    names_.push_back(path.substr(path.rfind('/') + 1));
  }
  progress_.resize(children_.size());
  held_ = HeldChildren(children_.size());
}

SynchronizedTick RecordedProbe::read(const RecordedTick& tick) {
  for (std::size_t child = 0; child < children_.size(); ++child) {
    const RecordedState& state = tick.nodes[children_[child]];
    progress_[child] = state.progress;
    held_.set(child, state.status, state.ticked, state.held);
  }
  const bool succeeded = std::ranges::find(tick.succeeded, node_) != tick.succeeded.end();
  return {.time = from_seconds(tick.time),
          .ticked = tick.nodes[node_].ticked,
          .status = succeeded ? Status::Success : tick.nodes[node_].status,
          .progress = progress_,
          .held = {held_.data(), children_.size()}};
}

}  // namespace lockstep

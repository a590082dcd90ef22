#include "recording/use/recorded_probe.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/resources.h"
#include "measure/measure_spec.h"

namespace lockstep::host {

std::vector<NodeIndex> synchronized_nodes(const RecordingHeader& header) {
  std::vector<NodeIndex> nodes;
  for (NodeIndex node = 0; node < header.nodes.size(); ++node) {
    if (header.nodes[node].synchronization != Synchronization::None) nodes.push_back(node);
  }
  return nodes;
}

std::vector<std::vector<NodeIndex>> children_of(const RecordingHeader& header) {
  std::vector<std::vector<NodeIndex>> children(header.nodes.size());
  for (NodeIndex node = 0; node < header.nodes.size(); ++node) {
    if (const auto parent = header.nodes[node].parent) children[*parent].push_back(node);
    if (!header.nodes[node].members.empty()) children[node] = header.nodes[node].members;
  }
  return children;
}

RecordedProbe::RecordedProbe(const RecordingHeader& header, NodeIndex node,
                             std::vector<NodeIndex> children)
    : node_(node),
      children_(std::move(children)),
      held_(children_.size()),
      synchronizes_(header.nodes[node].synchronization != Synchronization::None) {
  const RecordedNode& it = header.nodes[node];
  ignores_idle_ = it.ignores_idle;
  is_pool_ = it.synchronization == Synchronization::Resources;
  for (const NodeIndex child : children_) {
    const RecordedNode& held = header.nodes[child];
    names_.push_back(it.members.empty() ? last_segment(held.path) : held.path);
    if (!it.members.empty()) members_.push_back(held.parent.value_or(0));
  }
  if (!it.members.empty()) names_ = names_of(names_);
  find_around(header);
  last_.resize(children_.size(), Status::Idle);
  progress_.resize(children_.size());
}

// Nodes are in pre-order, so of two nodes the later one is never above the other.
void RecordedProbe::find_around(const RecordingHeader& header) {
  if (members_.empty()) return;
  skips_ = std::make_unique<Skips>();
  skips_->found.resize(members_.size());
  const auto parent = [&](NodeIndex node) { return header.nodes[node].parent.value_or(0); };
  NodeIndex ancestor = members_.front();
  for (NodeIndex other : members_) {
    while (other != ancestor)
      (other > ancestor ? other : ancestor) = parent(std::max(other, ancestor));
  }
  for (const NodeIndex member : members_) {
    auto& around = skips_->around.emplace_back();
    for (NodeIndex node = parent(member); node > ancestor; node = parent(node)) {
      around.push_back(node);
    }
  }
}

bool RecordedProbe::is_in_skipped(std::size_t child, const RecordedTick& tick) const {
  return std::ranges::any_of(skips_->around[child], [&](NodeIndex node) {
    return tick.nodes[node].status == Status::Skipped;
  });
}

SynchronizedTick RecordedProbe::read(const RecordedTick& tick) {
  const bool has_been_ended = std::ranges::find(tick.succeeded, node_) != tick.succeeded.end();
  const bool any_reached =
      std::ranges::any_of(children_, [&](NodeIndex node) { return tick.nodes[node].ticked; });
  for (std::size_t child = 0; child < children_.size(); ++child) {
    const RecordedState& state = tick.nodes[children_[child]];
    progress_[child] = synchronizes_ ? state.progress : in_plain_parallel(child, state);
    if (is_left_out(child)) progress_[child] = kLeftOut;
    last_[child] = tick.nodes[(members_.empty() ? children_ : members_)[child]].status;
    if (skips_) skips_->found[child] = is_in_skipped(child, tick);
    held_.set_succeeded(child, state.status, has_been_ended);
    if (is_pool_) {
      const RecordedState& member = tick.nodes[members_[child]];
      held_.set(child, member.ticked && waits(member.limit));
      continue;
    }
    const bool asked =
        members_.empty() ? any_reached || held_.held()[child] : tick.nodes[members_[child]].ticked;
    held_.set(child, state.status, state.ticked || !asked, state.held && asked);
  }
  runs_ = tick.nodes[node_].status == Status::Running;
  return {.time = from_seconds(tick.time),
          .ticked = tick.nodes[node_].ticked,
          .status = has_been_ended ? Status::Success : tick.nodes[node_].status,
          .limit = tick.nodes[node_].limit,
          .progress = progress_,
          .held = held_.held(),
          .succeeded = held_.succeeded()};
}

// A parallel that does not synchronize is judged by what was there before its tick, and none of its
// children has progress when it starts again. A child that it does not tick again counts as 1.
double RecordedProbe::in_plain_parallel(std::size_t child, const RecordedState& state) const {
  if (!runs_) return 0;
  return last_[child] == Status::Failure && !state.ticked ? 1 : state.progress;
}

// True for a child that was skipped in the last tick, or is in what was; in some groups also for a
// member that did not run, and had not succeeded, when the tick began.
bool RecordedProbe::is_left_out(std::size_t child) const {
  if (runs_ && last_[child] == Status::Skipped) return true;
  if (members_.empty() || progress_[child] != 0) return false;
  if (runs_ && skips_->found[child]) return true;
  return ignores_idle_ && (!runs_ || last_[child] == Status::Idle);
}

std::vector<RecordedMeasure> measures_of(const RecordingHeader& header) {
  auto children = children_of(header);
  const std::vector<NodeIndex> nodes = synchronized_nodes(header);
  std::vector<RecordedMeasure> measures;
  measures.reserve(nodes.size());
  for (const NodeIndex node : nodes) {
    const std::size_t count = children[node].size();
    const RecordedNode& it = header.nodes[node];
    measures.push_back({RecordedProbe(header, node, std::move(children[node])),
                        SynchronizedMeasure(count, it.synchronization, !it.members.empty())});
  }
  return measures;
}

}  // namespace lockstep::host

#include "record/use/recorded_probe.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/resources.h"

namespace lockstep::host {

namespace {

// A pool compares nothing.
Guards guards_of(const RecordingHeader& header, std::span<const NodeIndex> children, bool is_pool) {
  if (is_pool) return Guards();
  std::vector<bool> guards;
  for (const NodeIndex child : children) guards.push_back(header.nodes[child].is_guard);
  return Guards(std::move(guards));
}

// Until law 2, a recording names no children.
constexpr std::uint64_t kNamesSucceeded = 3;

}  // namespace

RecordedProbe::RecordedProbe(const RecordingHeader& header, NodeIndex node)
    : node_(node),
      children_(header.nodes[node].held()),
      names_(child_names(header, node)),
      held_(children_.size()),
      synchronizes_(header.nodes[node].synchronization != Synchronization::None) {
  const ShapeNode& it = header.nodes[node];
  ignores_idle_ = it.ignores_idle;
  is_pool_ = it.synchronization == Synchronization::Resources;
  names_succeeded_ = header.law >= kNamesSucceeded;
  for (const NodeIndex child : it.members) {
    members_.push_back(header.nodes[child].parent.value_or(0));
  }
  guards_ = guards_of(header, children_, is_pool_);
  find_around(header);
  last_.resize(children_.size(), Status::Idle);
  used_.resize(children_.size());
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

bool RecordedProbe::asked_children(const RecordedTick& tick) const {
  if (!tick.nodes[node_].ticked || !members_.empty()) return tick.nodes[node_].ticked;
  return std::ranges::any_of(children_, [&](NodeIndex child) { return tick.nodes[child].ticked; });
}

// Whether a child has succeeded, also where an ancestor has ended it since. Of a recording that
// does not say so, all are taken to have.
bool RecordedProbe::has_succeeded(NodeIndex child, const RecordedTick& tick) const {
  if (tick.nodes[child].status == Status::Success) return true;
  return std::ranges::find(tick.succeeded, names_succeeded_ ? child : node_) !=
         tick.succeeded.end();
}

SynchronizedTick RecordedProbe::read(const RecordedTick& tick) {
  const bool asked = asked_children(tick);
  for (std::size_t child = 0; child < children_.size(); ++child) {
    const RecordedState& state = tick.nodes[children_[child]];
    used_[child] = synchronizes_ ? state.progress : in_plain_parallel(child, state);
    if (is_left_out(child)) used_[child] = kLeftOut;
    last_[child] = tick.nodes[(members_.empty() ? children_ : members_)[child]].status;
    if (skips_) skips_->found[child] = is_in_skipped(child, tick);
    held_.set_succeeded(child, has_succeeded(children_[child], tick));
    if (is_pool_) {
      const RecordedState& member = tick.nodes[members_[child]];
      held_.set(child, member.ticked && waits(member.limit));
      continue;
    }
    const bool asks = members_.empty() ? asked : tick.nodes[members_[child]].ticked;
    held_.set(child, state.status, state.ticked || !asks, state.held && asks);
  }
  runs_ = tick.nodes[node_].status == Status::Running;
  return {.time = from_seconds(tick.time),
          .ticked = asked,
          .status = tick.nodes[node_].status,
          .limit = tick.nodes[node_].limit,
          .used = used_,
          .progress = guards_.leave_out(used_),
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
  if (members_.empty() || used_[child] != 0) return false;
  if (runs_ && skips_->found[child]) return true;
  return ignores_idle_ && (!runs_ || last_[child] == Status::Idle);
}

std::vector<RecordedMeasure> measures_of(const RecordingHeader& header) {
  const std::vector<NodeIndex> nodes = synchronized_nodes(header);
  std::vector<RecordedMeasure> measures;
  measures.reserve(nodes.size());
  for (const NodeIndex node : nodes) {
    const ShapeNode& it = header.nodes[node];
    RecordedProbe probe(header, node);
    SynchronizedMeasure measure(probe.children().size(), probe.guards(), it.synchronization,
                                !it.members.empty());
    measures.push_back({std::move(probe), std::move(measure)});
  }
  return measures;
}

}  // namespace lockstep::host

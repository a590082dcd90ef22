#include "engine/node_watch.h"

#include <algorithm>

#include "engine/node_context.h"

namespace lockstep::host {
namespace {

// Ends what runs in a node whose result is not that of its tick.
Status decide(NodeContext& context, NodeIndex self, const NodeKind& kind, bool begins,
              Status status) {
  if (!begins) context.halt(self);
  if (context.faulted()) return Status::Running;
  if (begins && kind.decided != nullptr) kind.decided(context, self, status);
  return status;
}

Status tick_inside(NodeContext& context, NodeIndex self) {
  const NodeWatches& watches = *context.watches();
  const NodeKind& kind = watches.inner_kind(self);
  const bool begins = context.first_tick(self);
  const auto decided = watches.watch()->before_tick(self);
  if (decided) return decide(context, self, kind, begins, *decided);
  return kind.tick(context, self);
}

// The tick of a node with scripts: tick_inside is within them.
Status tick_outside(NodeContext& context, NodeIndex self) {
  return context.tell_result(self, context.watches()->outer_kind(self).tick(context, self));
}

Status tick_plain(NodeContext& context, NodeIndex self) {
  return context.tell_result(self, tick_inside(context, self));
}

}  // namespace

NodeWatches::NodeWatches(const Tree& tree)
    : tree_(tree), nodes_(tree.nodes), hooked_(tree.hooked) {}

const NodeKind& NodeWatches::inner_kind(NodeIndex node) const {
  return has_scripts(node) ? *tree_.hooked[tree_.hooks[node]].kind : *tree_.nodes[node].kind;
}

const NodeKind* NodeWatches::copy_of(const NodeKind& kind,
                                     Status (*tick)(NodeContext&, NodeIndex)) {
  const auto found = std::ranges::find_if(
      copies_, [&](const Copy& it) { return it.from == &kind && it.kind.tick == tick; });
  if (found != copies_.end()) return &found->kind;
  copies_.push_back({&kind, kind});
  copies_.back().kind.tick = tick;
  return &copies_.back().kind;
}

void NodeWatches::watch(std::span<const NodeIndex> nodes, NodeWatch* watch) {
  watch_ = watch;
  for (NodeIndex node = 0; node < nodes_.size(); ++node) nodes_[node].kind = tree_.nodes[node].kind;
  std::ranges::copy(tree_.hooked, hooked_.begin());
  if (watch == nullptr) return;
  for (const NodeIndex node : nodes) {
    const NodeKind& kind = *tree_.nodes[node].kind;
    nodes_[node].kind = copy_of(kind, has_scripts(node) ? tick_outside : tick_plain);
    if (!has_scripts(node)) continue;
    HookedNode& hooked = hooked_[tree_.hooks[node]];
    hooked.kind = copy_of(*tree_.hooked[tree_.hooks[node]].kind, tick_inside);
  }
}

Status NodeContext::tell_result(NodeIndex node, Status status) {
  if (watches_ == nullptr || !watches_->is_watched(node) || state_.faulted) return status;
  const auto decided = watches_->watch()->after_tick(node, status);
  if (!decided || *decided == status) return status;
  const bool runs = status == Status::Running;
  if (runs) state_.activity[node] = Activity::Running;
  return decide(*this, node, watches_->inner_kind(node), !runs, *decided);
}

}  // namespace lockstep::host

#include "verify/tick_points.h"

#include <algorithm>

#include "engine/nodes/fold.h"
#include "engine/synchronized.h"
#include "verify/labels.h"

namespace lockstep::host {

bool is_plain(const Tree& tree) {
  return tree.groups.empty() && tree.members.empty() && tree.readings.empty() &&
         tree.bound.empty() && !tree.keeps_over_skips;
}

TickPoints::TickPoints(const Tree& tree, const LeafModels& models, const std::vector<bool>& watched,
                       std::uint64_t few_ticks)
    : tree_(tree),
      models_(models),
      few_(few_ticks),
      can_look_(is_plain(tree)),
      has_properties_(std::ranges::find(watched, true) != watched.end()),
      halts_only_(tree.nodes.size()) {
  std::vector<bool> counts = watched;
  counts.resize(tree.nodes.size());
  for (const Holdable& it : holdable(tree)) counts[it.child] = true;
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    const NodeKind& kind = *tree.nodes[node].kind;
    const std::size_t bytes =
        kind.state_size + std::size_t{kind.state_per_child} * tree.nodes[node].children;
    constexpr std::size_t kWord = sizeof(std::uint64_t);
    words_.push_back({static_cast<std::uint32_t>(tree.nodes[node].state / kWord),
                      static_cast<std::uint32_t>((bytes + kWord - 1) / kWord),
                      kind.fold == fold::dead, kind.fold == fold::dead_when_idle});
    const Words& words = words_.back();
    if (words.count != 0 && !words.is_dead && !words.is_dead_when_idle) counts[node] = true;
    if (counts[node]) kept_.push_back(node);
  }
  if (can_look_) find_parallels();
}

// A script may run when a node is halted, and some kinds do something then. After a cut, each
// barrier that a child passes is looked at. With hold="between", a leaf may be held because of what
// those before it do.
void TickPoints::find_parallels() {
  if (models_.cuts.most > 0) return;
  std::vector<bool> does_something(tree_.nodes.size());
  for (const HookedNode& it : tree_.hooked) does_something[it.node] = true;
  for (NodeIndex node = tree_.nodes[0].end; node-- > 0;) {
    const NodeKind& kind = *tree_.nodes[node].kind;
    if (kind.sure_to_end != nullptr && holds_between(tree_, node)) {
      halts_only_.assign(tree_.nodes.size(), false);
      return;
    }
    if (kind.halt != nullptr && tree_.labels[node].type->leaf == nullptr) {
      does_something[node] = true;
    }
    if (does_something[node] && node != 0) does_something[tree_.labels[node].parent] = true;
    halts_only_[node] = kind.sure_to_end != nullptr && !does_something[node];
  }
}

void TickPoints::begin_state(const std::vector<Activity>& nodes,
                             const std::vector<LeafState>& leaves) {
  ticks_ = hits_ = 0;
  looks_ = false;
  if (known_.size() > 0) known_.clear();
  if (!can_look_) return;
  if (has_properties_) {
    nodes_ran_.clear();
    for (const Activity it : nodes) nodes_ran_.push_back(status_of(it) == Status::Running);
  }
  ran_.clear();
  has_run_.assign(leaves.size(), 0);
  for (std::uint32_t leaf = 0; leaf < leaves.size(); ++leaf) {
    if (!leaves[leaf].runs()) continue;
    has_run_[leaf] = 1;
    if (models_.leaves[leaf].ends) ran_.push_back(leaf);
  }
}

bool TickPoints::add(const Ticker& ticker, const ModelLeaves& leaves, const TickAnswers& answers,
                     const StateCode& code, std::uint32_t asker, std::uint64_t root_ticks) {
  const RunState& run = ticker.run_state();
  // A property looks at moments.
  if (!run.kept_values.empty() || (has_properties_ && !ticker.moments().empty())) return false;
  point_.clear();
  put(asker);
  put(root_ticks);
  put(run.asked_by);
  put(run.interrupted);
  put(code.cuts());
  const std::uint32_t chooses = leaves.chooses();
  put(chooses);
  if (chooses != ModelLeaves::kNobody) {
    const LeafMark& mark = leaves.marks()[chooses];
    put(mark.result);
    put(mark.ended);
    put(leaves.stage());
  }
  put_nodes(ticker,
            chooses == ModelLeaves::kNobody ? tree_.nodes[0].end : tree_.leaves[chooses].node);
  bool has_begun = false;
  for (const std::uint32_t leaf : leaves.touched()) {  // the others are as they were
    has_begun = has_begun || (models_.leaves[leaf].ends && has_run_[leaf] == 0);
    const LeafState& state = leaves.states()[leaf];
    if (state.phase == Phase::Idle || is_halted_in_the_end(tree_.leaves[leaf].node)) continue;
    put(leaf);
    put(state.ticks);
    put(state.level);
    put(state.phase);
    put(leaves.marks()[leaf].is_open);
  }
  put(ModelLeaves::kNobody);
  put(has_begun);
  for (const std::uint32_t leaf : ran_) {
    if (is_halted_in_the_end(tree_.leaves[leaf].node)) continue;  // then it has ended
    put(leaves.marks()[leaf].ticked);
    put(leaves.marks()[leaf].ended);
  }
  leaves.for_each_fact([this](const auto& it) { put(it); });
  answers.for_each_tie([this](const auto& it) { put(it); });
  code.add_entries(ticker, point_);
  const bool is_known = !known_.add(point_).second;
  if (is_known) ++hits_;
  return is_known;
}

bool TickPoints::is_ticked_behind(const RunState& run, NodeIndex chooses) const {
  bool any = false;
  for (NodeIndex node = chooses + 1; node < tree_.nodes[0].end; ++node) {
    const std::uint32_t tick = run.last_tick[node];
    any |= (tick == run.tick_number) | (tick == ~run.tick_number);
  }
  return any;
}

bool TickPoints::is_halted_in_the_end(NodeIndex node) const {
  return std::ranges::any_of(halted_,
                             [&](const auto& it) { return it.first <= node && node < it.second; });
}

NodeIndex TickPoints::child_with(NodeIndex node, NodeIndex inside) const {
  NodeIndex child = node + 1;
  while (tree_.nodes[child].end <= inside) child = tree_.nodes[child].end;
  return child;
}

// Of a node in its tick.
bool TickPoints::put_sure_to_end(const Ticker& ticker, NodeIndex node, NodeIndex next) {
  StatusCounts before{};
  for (NodeIndex child = node + 1; child != next; child = tree_.nodes[child].end) {
    ++before[index_of(ticker.status(child))];
  }
  const auto outcome = tree_.nodes[node].kind->sure_to_end(ticker, node, before);
  put(outcome.has_value());
  if (outcome) put(*outcome);
  return outcome.has_value();
}

// What is below a node that has completed is reset before its next tick. It has not if the leaf
// that chooses is in it: then its tick goes on, and its status is an earlier one. What is behind
// that leaf and has not been ticked is as it was, or follows from what is before it.
void TickPoints::put_nodes(const Ticker& ticker, NodeIndex chooses) {
  halted_.clear();
  NodeIndex end = tree_.nodes[0].end;
  if (chooses < end && !is_ticked_behind(ticker.run_state(), chooses)) end = chooses + 1;
  for (NodeIndex node = 0; node < end;) {
    const NodeIndex after = tree_.nodes[node].end;
    const bool is_in_its_tick = node <= chooses && chooses < after;
    put_node(ticker, node, is_in_its_tick);
    if (is_in_its_tick && node < chooses && halts_only_[node]) {
      const NodeIndex next = child_with(node, chooses);
      if (put_sure_to_end(ticker, node, next)) {
        put_kept(ticker, node + 1, next);
        if (has_properties_) put(ends_moment(ticker, node + 1, next));
        halted_.emplace_back(node + 1, next);
        node = next;
        continue;
      }
    }
    const bool is_over =
        !is_in_its_tick && has_ended(ticker.status(node)) && ticker.ticked_so_far(node);
    if (!is_over || after == node + 1) {
      ++node;
      continue;
    }
    put_kept(ticker, node + 1, after);
    node = after;
  }
}

// The first of these children with whose halt a moment ends, as NodeContext::halt_range does it; 0
// if there is none. A property looks at each moment. Nodes that are held are among kept_.
NodeIndex TickPoints::ends_moment(const Ticker& ticker, NodeIndex first, NodeIndex last) const {
  const auto is_new = [&](NodeIndex node) {
    const NodeState it = NodeState::of(ticker.activity(node), ticker.ticked_so_far(node));
    if (it.held() || !it.ticked() || it.status() == Status::Idle) return false;
    return it.status() != Status::Running || nodes_ran_[node] == 0;
  };
  for (NodeIndex child = first; child != last; child = tree_.nodes[child].end) {
    if (ticker.status(child) != Status::Running) continue;
    for (NodeIndex node = child; node < tree_.nodes[child].end; ++node) {
      if (is_new(node)) return child;
    }
  }
  return 0;
}

void TickPoints::put_kept(const Ticker& ticker, NodeIndex first, NodeIndex last) {
  auto kept = std::ranges::lower_bound(kept_, first);
  for (; kept != kept_.end() && *kept < last; ++kept) put_node(ticker, *kept, false);
}

void TickPoints::put_node(const Ticker& ticker, NodeIndex node, bool is_in_its_tick) {
  put(NodeState::of(ticker.activity(node), ticker.ticked_so_far(node)).bits);
  const Words& words = words_[node];
  if (words.count == 0) return;
  if (!is_in_its_tick) {
    const bool runs = ticker.status(node) == Status::Running;
    if (words.is_dead || (words.is_dead_when_idle && !runs)) return;
  }
  const std::size_t size = point_.size(), bytes = words.count * sizeof(std::uint64_t);
  point_.resize(size + bytes);
  std::memcpy(point_.data() + size, &ticker.run_state().bytes[words.first], bytes);
}

}  // namespace lockstep::host

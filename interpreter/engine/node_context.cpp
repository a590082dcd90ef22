#include "engine/node_context.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/core/shortened.h"
#include "engine/groups.h"
#include "engine/held_leaves.h"
#include "engine/node_ports.h"
#include "engine/node_scripts.h"
#include "engine/node_watch.h"
#include "engine/readings.h"
#include "engine/tree.h"

namespace lockstep::host {
namespace {

// True if none of the next eight bytes is 0 (S. E. Anderson, "Bit Twiddling Hacks").
bool has_no_idle(const Activity* first) {
  std::uint64_t block = 0;
  std::memcpy(&block, first, sizeof block);
  return ((block - 0x0101010101010101u) & ~block & 0x8080808080808080u) == 0;
}

}  // namespace

// Node kinds and this file reach these by reference, so that the header does not include them.
struct NodeContext::Beside {
  Beside(NodeContext& context, Blackboard& board, RunState& state, std::size_t leaves)
      : ports(context.tree(), board),
        readings(context.tree()),
        scripts(context, context.tree(), board, ports.names(), readings),
        groups(context.tree(), state),
        held_leaves(leaves) {}

  NodePorts ports;
  Readings readings;
  NodeScripts scripts;
  Groups groups;
  HeldLeaves held_leaves;

  // Of each node, and since which call of share_progress it is known.
  std::vector<double> progress;
  std::vector<std::uint64_t> known_since;
  std::uint64_t shared = 0;  // how often
};

NodeContext::NodeContext(const Tree& tree, std::span<LeafSlot> leaves, Blackboard& board,
                         FaultPolicy policy, LeafWatch* watch)
    : RunView(tree, board),
      leaves_(leaves),
      parameters_(tree, board),
      beside_(std::make_unique<Beside>(*this, board, state_, leaves.size())),
      ports_(beside_->ports),
      scripts_(beside_->scripts),
      groups_(beside_->groups),
      held_leaves_(beside_->held_leaves),
      readings_(beside_->readings),
      policy_(policy),
      watch_(watch),
      notes_halts_(tree.has_halt_hooks) {
  if (watch_ != nullptr) watch_->begin_run(tree, leaves_, &is_usual_);
}

NodeContext::~NodeContext() {
  if (watch_ != nullptr) watch_->end_run();
}

void NodeContext::share_progress() {
  if (shares_progress_) return;
  shares_progress_ = true;
  if (++beside_->shared > 1) return;
  beside_->progress.resize(tree_.nodes.size());
  beside_->known_since.resize(tree_.nodes.size());
}

[[gnu::noinline]] double NodeContext::shared_progress(NodeIndex node) {
  if (beside_->known_since[node] != beside_->shared) {
    beside_->progress[node] = ask_progress(node);
    beside_->known_since[node] = beside_->shared;
  }
  return beside_->progress[node];
}

double NodeContext::progress_in_tick(NodeIndex node, NodeIndex below) {
  const Activity before = std::exchange(state_.activity[below], Activity::Running);
  const double progress =
      below == node ? ask_progress(node) : progress_in_tick(node, parent_of(below));
  state_.activity[below] = before;
  return progress;
}

double NodeContext::progress_before_tick(NodeIndex node) const {
  const bool is_known =
      node < beside_->known_since.size() && beside_->known_since[node] == beside_->shared;
  return is_known ? beside_->progress[node] : 0.0;
}

[[gnu::noinline]] Status NodeContext::tick_apart(NodeIndex node) {
  return tick(node);
}

Status NodeContext::tick_unreset(NodeIndex node) {
  if (state_.faulted) return Status::Running;
  const Node& it = nodes_[node];
  const HookedNode* const hooked = scripts_.around(node);
  const NodeKind& kind = hooked != nullptr ? *hooked->kind : *it.kind;
  const Unreset how =
      kind.unreset != nullptr ? kind.unreset(*this, node) : unreset_by(*tree_.labels[node].type);
  Status result = status(node);
  if (how != Unreset::KeepsResult) {
    if (it.children != 0) forget_descendants(node);
    state_.activity[node] = how == Unreset::GoesOn ? Activity::Running : Activity::Idle;
    result = kind.tick(*this, node);
  }
  if (hooked != nullptr) {
    result = tell_result(node, scripts_.finish(node, *hooked, result));
  }
  if (state_.faulted) result = Status::Running;
  state_.activity[node] = static_cast<Activity>(result);
  state_.last_tick[node] = state_.tick_number;
  return result;
}

void NodeContext::say(NodeIndex node, LeafSlot& leaf, std::string_view text) {
  if (leaf.reason_place != 0 || !text.empty()) say(node, leaf.reason_place, text);
}

void NodeContext::say(NodeIndex node, std::uint32_t& place, std::string_view text) {
  Reason& reason = reasons_[(place = place_of_reason(node, place)) - 1];
  reason.number = text.empty() ? 0 : state_.tick_number;
  reason.text = text;
  reason.of_fault = false;
}

bool NodeContext::say_again(NodeIndex node, std::uint32_t& place) {
  Reason& reason = reasons_[(place = place_of_reason(node, place)) - 1];
  reason.number = state_.tick_number;
  return !reason.text.empty();
}

void NodeContext::say_fault(NodeIndex node, const std::string& message) {
  const bool is_leaf = tree_.labels[node].type->leaf != nullptr;
  const std::uint32_t place = place_of_reason(node, is_leaf ? leaf(node).reason_place : 0);
  if (is_leaf) leaf(node).reason_place = place;
  Reason& reason = reasons_[place - 1];
  reason.number = state_.tick_number;
  reason.text = Shortened("fault: " + message).text();
  reason.of_fault = true;
}

void NodeContext::fail_with_fault(const LeafSlot& leaf) {
  if (leaf.reason_place == 0) return;
  Reason& reason = reasons_[leaf.reason_place - 1];
  if (reason.of_fault) reason.number = state_.tick_number;
}

// `known` may be 0, or of another run.
std::uint32_t NodeContext::place_of_reason(NodeIndex node, std::uint32_t known) {
  if (known != 0 && known <= reasons_.size() && reasons_[known - 1].node == node) return known;
  auto it = std::ranges::find(reasons_, node, &Reason::node);
  if (it == reasons_.end()) {
    it = reasons_.insert(it, {.node = node});
    it->text.reserve(kMostOfReason);
  }
  return static_cast<std::uint32_t>(it - reasons_.begin()) + 1;
}

// A subtree that was not reached costs nothing, however large it is: below an idle node all are
// idle. Where all are active, eight nodes at a time. What a skipped node keeps is over when its
// parent has completed, not when that was skipped too.
void NodeContext::forget_descendants(NodeIndex node) {
  if (tree_.keeps_over_skips && state_.activity[node] != Activity::Skipped) {
    forget_range(node + 1, nodes_[node].end);
  }
  constexpr NodeIndex kBlock = sizeof(std::uint64_t);
  Activity* const all = state_.activity.data();
  const NodeIndex end = nodes_[node].end;
  for (NodeIndex at = node + 1; at < end;) {
    if (all[at] == Activity::Idle) {
      at = nodes_[at].end;
    } else if (end - at >= kBlock && has_no_idle(all + at)) {
      std::memset(all + at, 0, kBlock);
      at += kBlock;
    } else {
      all[at++] = Activity::Idle;
    }
  }
}

void NodeContext::forget_range(NodeIndex first, NodeIndex last) {
  if (!tree_.keeps_over_skips) return;
  for (NodeIndex node = first; node < last; ++node) {
    const auto forget = nodes_[node].kind->forget;
    if (state_.activity[node] == Activity::Skipped && forget != nullptr) forget(*this, node);
  }
}

// Returns the next node that may not be idle.
NodeIndex NodeContext::end_activation(NodeIndex node) {
  Activity& activity = state_.activity[node];
  if (activity == Activity::Idle) return nodes_[node].end;
  const bool running = status_of(activity) == Status::Running;
  if (activity == Activity::Success && ticked_so_far(node)) state_.ended.push_back(node);
  const NodeKind& kind = *nodes_[node].kind;
  if (activity == Activity::Skipped && kind.forget != nullptr) kind.forget(*this, node);
  activity = Activity::Idle;
  if (running && notes_halts_) scripts_.note_halt(node);
  if (running && kind.halt != nullptr) kind.halt(*this, node);
  return node + 1;
}

void NodeContext::halt_range(NodeIndex first, NodeIndex last) {
  if (moments_ != nullptr && moments_->in_tick()) [[unlikely]]
    return halt_range_in_moments(first, last);
  end_range(first, last);
}

// What has begun, completed or been held in this moment is told before it is reset. Also what
// completes in a halt of something else, as the last child of a TryCatch may.
void NodeContext::halt_range_in_moments(NodeIndex first, NodeIndex last) {
  const bool is_outermost = !moments_->halts_under;
  if (is_outermost) moments_->halts_under = parent_of(first);
  keep_results_until(first, last);
  end_range(first, last);
  if (is_outermost) moments_->halts_under.reset();
}

void NodeContext::keep_results_until(NodeIndex first, NodeIndex last) {
  const auto is_new = [&](NodeIndex node) {
    if (held(node)) return moments_->is_withheld(node);
    if (!ticked(node) || status(node) == Status::Idle) return false;
    return status(node) != Status::Running || !moments_->was_running(node);
  };
  for (NodeIndex node = first; node < last; ++node) {
    if (!is_new(node)) continue;
    moments_->next(state_, moments_->halts_under);
    return;
  }
}

NodeIndex NodeContext::parent_of(NodeIndex node) const {
  return tree_.labels[node].parent;
}

void NodeContext::end_range(NodeIndex first, NodeIndex last) {
  const std::size_t begin = scripts_.halted();
  // After a fault all halts are halt_all's, so that they come in one order.
  const auto is_left_to_last_halt = [this] { return state_.faulted && !state_.in_last_halt; };
  for (NodeIndex node = first; node < last && !is_left_to_last_halt();) {
    if (scripts_.halted() > begin) scripts_.run_halted(begin, node);
    if (is_left_to_last_halt()) break;  // a script of what was halted before it
    if (moments_ != nullptr && moments_->in_tick()) [[unlikely]]
      keep_results_until(node, node + 1);
    node = end_activation(node);
  }
  if (state_.faulted) [[unlikely]]
    keep_ancestors_running();
  if (scripts_.halted() > begin) {
    scripts_.run_halted(begin, last);
    if (state_.faulted) [[unlikely]]
      keep_ancestors_running();
  }
}

bool NodeContext::is_halted_again(NodeIndex node) const {
  if (!state_.faulted || state_.in_last_halt) return false;
  const NodeIndex wrong = state_.fault.node;
  return status(node) == Status::Running || (node < wrong && wrong < nodes_[node].end);
}

void NodeContext::halt_running_children(NodeIndex node) {
  for (NodeIndex child = node + 1; child != end_of(node); child = end_of(child)) {
    if (status(child) == Status::Running) halt(child);
  }
}

void NodeContext::pause(NodeIndex node) {
  for (NodeIndex at = node; at < nodes_[node].end && !state_.faulted;) {
    const Node& it = nodes_[at];
    if (state_.activity[at] != Activity::Running) {  // so nothing below it needs a call either
      at = it.end;
      continue;
    }
    state_.activity[at] = Activity::Paused;
    if (it.kind->pause != nullptr) it.kind->pause(*this, at);
    ++at;
  }
}

void NodeContext::set_fault(NodeIndex node, std::string message) {
  Fault fault{node, std::move(message), state_.in_last_halt};
  if (state_.in_last_halt ? state_.faulted : policy_ == FaultPolicy::Fail) {
    if (tree_.labels[node].type->leaf != nullptr) note_failed_leaf(node);
    say_fault(node, fault.message);
    state_.tolerated.push_back(std::move(fault));
    return;
  }
  if (state_.faulted) return;  // the first is the cause
  state_.faulted = state_.interrupted = true;
  end_calls_in_line();
  state_.fault = std::move(fault);
}

void NodeContext::end_calls_in_line() {
  in_line_ = nullptr;
  is_usual_.clear();
}

void NodeContext::keep_ancestors_running() {
  if (state_.in_last_halt) return;
  NodeIndex node = state_.fault.node;
  // The node too, if it halts its children itself and some of them run.
  for (NodeIndex child = node + 1; child < end_of(node); child = end_of(child)) {
    if (status(child) == Status::Running) state_.activity[node] = Activity::Running;
  }
  while (node != tree_.labels[node].parent) {
    node = tree_.labels[node].parent;
    if (status(node) != Status::Running) state_.activity[node] = Activity::Running;
  }
}

void NodeContext::note_out_of_range(NodeIndex node, double reported) {
  if (std::exchange(leaf(node).out_of_range, true)) return;
  state_.out_of_range.push_back({node, reported});
}

void NodeContext::watch_held(NodeIndex node) {
  held_leaves_.add(*this, node);
}

}  // namespace lockstep::host

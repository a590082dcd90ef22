// The nodes of plugins, mostly leaves: the only place where the engine calls the C ABI. Whatever
// one does against its contract becomes a fault here. A fault that the
// run goes on after marks the leaf's slot until the activation has ended, with a Failure or a halt.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/core/plugin_exception.h"
#include "base/core/progress.h"
#include "engine/cut.h"
#include "engine/held_leaves.h"
#include "engine/leaf_call.h"
#include "engine/node_kind.h"
#include "engine/nodes/fold.h"
#include "engine/pace.h"
#include "engine/tree.h"

namespace lockstep::host {
namespace {

enum class Kind { Action, Condition, Control };

// Gives a control node access to its children during a call.
class Reach {
 public:
  Reach(LeafSlot& leaf, ChildAccess access) : leaf_(leaf) { leaf_.access = access; }
  ~Reach() { leaf_.access = ChildAccess::None; }
  Reach(const Reach&) = delete;
  Reach& operator=(const Reach&) = delete;

 private:
  LeafSlot& leaf_;
};

// The contract forbids exceptions, but a leaf that throws must not take the robot with it.
template <class Call>
void guarded(NodeContext& context, NodeIndex self, PluginFunction function, Call call) {
  LeafSlot& leaf = context.leaf(self);
  const LeafCall around(context, self, leaf, function);
  try {
    call(leaf);
  } catch (...) {
    context.set_fault(self, describe_exception());
  }
}

// Takes an error that the leaf has set; true if there was one.
bool take_error(NodeContext& context, NodeIndex self, LeafSlot& leaf) {
  if (leaf.error == nullptr) return false;
  context.set_fault(self, leaf.error);
  leaf.set_error(nullptr);
  return true;
}

template <PluginFunction kName>
void call(NodeContext& context, NodeIndex self, void (*function)(void*)) {
  LeafSlot& leaf = context.leaf(self);
  const Reach reach(leaf, ChildAccess::Look);
  if (function != nullptr) {
    guarded(context, self, kName, [function](const LeafSlot& it) { function(it.self); });
  }
  take_error(context, self, leaf);
}

// A control node that halts its children itself; those that it leaves are halted after it.
void halt_before_children(NodeContext& context, NodeIndex self, LeafSlot& leaf) {
  if (leaf.started() && leaf.type->halt != nullptr) {
    const Reach reach(leaf, ChildAccess::Tick);
    guarded(context, self, PluginFunction::Halt,
            [](const LeafSlot& it) { it.type->halt(it.self); });
    take_error(context, self, leaf);
  }
  if (context.faulted()) leaf.set_started(false);
  context.halt_range(self + 1, context.end_of(self));
  leaf.mark(LeafSlot::kFailed | LeafSlot::kCut, false);
}

// Children are halted before their control node.
template <Kind kKind>
void halt_leaf(NodeContext& context, NodeIndex self) {
  LeafSlot& leaf = context.leaf(self);
  if constexpr (kKind == Kind::Control) {
    if ((leaf.type->flags & LOCKSTEP_HALTS_CHILDREN) != 0) {
      return halt_before_children(context, self, leaf);
    }
    context.halt_range(self + 1, context.end_of(self));
    if (context.faulted() && !context.in_last_halt()) return;  // halted at the end of the run
  }
  if (leaf.started()) call<PluginFunction::Halt>(context, self, leaf.type->halt);
  if (context.faulted()) leaf.set_started(false);  // not again at the end of the run
  leaf.mark(LeafSlot::kFailed | LeafSlot::kCut, false);
}

// No function of the leaf is called any more but halt, in its time.
bool is_out(const NodeContext& context, const LeafSlot& leaf) {
  return leaf.is_out() || context.faulted();
}

template <Kind kKind, bool kObeys>
Status tick_leaf(NodeContext& context, NodeIndex self);

// Ends a tick once the leaf is out. One that was cut begins again, or has its result.
template <Kind kKind, bool kObeys = false>
Status out(NodeContext& context, NodeIndex self) {
  if (context.faulted()) return Status::Running;  // halted at the end of the run, in its order
  if (context.leaf(self).was_cut() && !context.leaf(self).failed()) {
    const Status result = context.begin_after_cut(self);
    return result == Status::Running ? tick_leaf<kKind, kObeys>(context, self) : result;
  }
  halt_leaf<kKind>(context, self);
  context.fail_with_fault(context.leaf(self));
  return Status::Failure;
}

[[gnu::noinline]] void start(NodeContext& context, NodeIndex self, LeafSlot& leaf) {
  const bool is_unreset = leaf.unreset();
  leaf.set_started(false);
  if (is_unreset) {
    leaf.mark(LeafSlot::kUnreset, false);
    call<PluginFunction::StartUnreset>(context, self, leaf.type->start_unreset);
  } else if (LeafCall::can_be_in_line(context, leaf) && context.end_of(self) == self + 1) {
    LeafCall::in_line<PluginFunction::Start>(context, leaf, leaf.type->start);
    if (leaf.error != nullptr) take_error(context, self, leaf);
  } else {
    call<PluginFunction::Start>(context, self, leaf.type->start);
  }
  leaf.set_started(!is_out(context, leaf));
}

[[gnu::noinline]] void resume(NodeContext& context, NodeIndex self, LeafSlot& leaf) {
  if (!leaf.is_out()) call<PluginFunction::Resume>(context, self, leaf.type->resume);
}

// The first tick of an activation, or the first after a pause. False: the leaf is out.
bool prepare(NodeContext& context, NodeIndex self, LeafSlot& leaf) {
  const Activity before = context.activity(self);
  if (before == Activity::Running) return !leaf.is_out();
  leaf.mark(LeafSlot::kHeld, false);
  if (before == Activity::Paused) {
    resume(context, self, leaf);
  } else if (leaf.type->start == nullptr && !leaf.unreset()) {
    leaf.mark(LeafSlot::kStarts | LeafSlot::kRests, false);
  } else {
    start(context, self, leaf);
  }
  return !is_out(context, leaf);
}

template <Kind kKind>
bool is_result(lockstep_status status) {
  if (kKind == Kind::Condition && status == LOCKSTEP_RUNNING) return false;
  return status > LOCKSTEP_IDLE && status <= static_cast<int>(kLastStatus);
}

// For a condition.
bool may_run(const LeafSlot& leaf, lockstep_status result) {
  return result == LOCKSTEP_RUNNING && (leaf.type->flags & LOCKSTEP_MAY_RUN) != 0;
}

// Ends a tick that did not go well. Out of line, so that the checks of each tick are inline.
template <Kind kKind>
[[gnu::cold, gnu::noinline]] Status spoiled(NodeContext& context, NodeIndex self, LeafSlot& leaf,
                                            lockstep_status result) {
  if (!take_error(context, self, leaf) && !is_out(context, leaf) && !may_run(leaf, result)) {
    context.set_fault(self, result == LOCKSTEP_RUNNING
                                ? std::string("is a condition and returned running")
                                : "returned status " + std::to_string(result) +
                                      ", expected one of lockstep/leaf.h");
  }
  return leaf.failed() ? out<kKind>(context, self) : Status::Running;
}

// What the result of a tick means: no other place says so. The loop of leaves goes on after the one
// result that it was made for, and has all others from here (LeafCall::complete).
template <Kind kKind>
Status meaning_of(NodeContext& context, NodeIndex self, LeafSlot& leaf, lockstep_status result,
                  bool is_out_now) {
  if (leaf.error == nullptr && !is_out_now && is_result<kKind>(result)) [[likely]]
    return static_cast<Status>(result);
  return spoiled<kKind>(context, self, leaf, result);
}

lockstep_status call_tick(NodeContext& context, NodeIndex self) {
  lockstep_status result = LOCKSTEP_IDLE;  // no result, as after an exception
  guarded(context, self, PluginFunction::Tick,
          [&result](const LeafSlot& leaf) { result = leaf.type->tick(leaf.self); });
  return result;
}

// Gives the leaf its factor, if that has changed. False: the leaf is out.
bool follow_pace(NodeContext& context, NodeIndex self, LeafSlot& leaf) {
  auto& pace = context.state<LeafPace>(self);
  const double wanted = factor_of(context.pace());
  if (wanted == pace.told || leaf.type->set_pace == nullptr) return true;
  pace.told = wanted;
  double taken = 1;
  guarded(context, self, PluginFunction::SetPace,
          [&](const LeafSlot& it) { taken = it.type->set_pace(it.self, wanted); });
  if (!take_error(context, self, leaf) && !is_out(context, leaf) && std::isnan(taken)) {
    context.set_fault(self, "returned a pace that is not a number");
  }
  pace.taken = std::isnan(taken) ? 1.0 : std::clamp(taken, wanted, 1.0);
  return !is_out(context, leaf);
}

template <Kind kKind, bool kObeys>
Status tick_leaf(NodeContext& context, NodeIndex self) {
  LeafSlot& leaf = context.leaf(self);
  if constexpr (kObeys) {
    if (context.first_tick(self)) context.state<LeafPace>(self) = {.told = 1, .taken = 1};
  }
  if (!prepare(context, self, leaf)) [[unlikely]]
    return out<kKind, kObeys>(context, self);
  if constexpr (kObeys) {
    if (!follow_pace(context, self, leaf)) return out<kKind>(context, self);
  }
  lockstep_status result = LOCKSTEP_IDLE;
  bool is_out_now = false;  // what a node without children reports is its error
  if constexpr (kKind == Kind::Control) {
    const Reach reach(leaf, ChildAccess::Tick);
    result = call_tick(context, self);
    is_out_now = is_out(context, leaf);
  } else if (LeafCall::can_be_in_line(context, leaf)) {
    result = LeafCall::in_line<PluginFunction::Tick>(context, leaf, leaf.type->tick);
  } else {
    result = call_tick(context, self);
  }
  return meaning_of<kKind>(context, self, leaf, result, is_out_now);
}

// It ends in the tick after the checkpoint with its success is on the disk.
Status tick_committing(NodeContext& context, NodeIndex self) {
  auto& state = context.state<CommitState>(self);
  if (context.first_tick(self)) state.has_succeeded = 0;
  if (state.has_succeeded != 0) {
    return context.is_durable(state.succeeded_at) ? Status::Success : Status::Running;
  }
  const Status result = tick_leaf<Kind::Action, true>(context, self);
  const std::uint32_t now = context.run_state().tick_number;
  if (result != Status::Success || context.is_durable(now)) return result;
  state.succeeded_at = now;
  state.has_succeeded = 1;
  context.leaf(self).set_started(false);
  context.note_commit();
  return Status::Running;
}

bool has_to_commit(NodeContext& context, NodeIndex self) {
  return context.state<CommitState>(self).has_succeeded != 0;
}

Status tick_control(NodeContext& context, NodeIndex self) {
  const Status status = tick_leaf<Kind::Control, false>(context, self);
  if (status != Status::Running) context.halt_running_children(self);
  return status;
}

Unreset unreset_leaf(NodeContext& context, NodeIndex self) {
  LeafSlot& leaf = context.leaf(self);
  leaf.mark(LeafSlot::kUnreset, leaf.type->start_unreset != nullptr);
  return leaf.unreset() ? Unreset::Begins : unreset_by(*context.tree().labels[self].type);
}

void pause(NodeContext& context, NodeIndex self) {
  LeafSlot& leaf = context.leaf(self);
  if (!leaf.is_out()) call<PluginFunction::Pause>(context, self, leaf.type->pause);
}

void pause_leaf(NodeContext& context, NodeIndex self) {
  context.leaf(self).mark(LeafSlot::kHeld, true);
  pause(context, self);
  if (!context.faulted()) context.watch_held(self);
}

void pause_control(NodeContext& context, NodeIndex self) {
  for (NodeIndex child = self + 1; child != context.end_of(self); child = context.end_of(child)) {
    context.pause(child);
  }
  if (!context.faulted()) pause(context, self);
}

double corrected(NodeContext& context, NodeIndex self, LeafSlot& leaf, double reported) {
  if (take_error(context, self, leaf)) return LeafCall::last_progress(context, self);
  if (std::isnan(reported)) {
    context.set_fault(self, "reported a progress that is not a number");
    return 0.0;
  }
  if (reported < -kProgressEpsilon || reported > 1 + kProgressEpsilon) {
    context.note_out_of_range(self, reported);
  }
  return std::clamp(reported, 0.0, 1.0) + 0.0;  // -0 is 0
}

double progress_of_leaf(NodeContext& context, NodeIndex self) {
  LeafSlot& leaf = context.leaf(self);
  if (leaf.is_out()) return LeafCall::last_progress(context, self);
  double reported = 0.0;
  if (leaf.kept_progress != nullptr) {
    reported = leaf.read_progress();
  } else if (leaf.type->progress != nullptr) {
    guarded(context, self, PluginFunction::Progress,
            [&reported](const LeafSlot& it) { reported = it.type->progress(it.self); });
  }
  if (leaf.error == nullptr && reported >= 0.0 && reported <= 1.0) [[likely]]
    return reported;
  return corrected(context, self, leaf, reported);
}

void pause_committing(NodeContext& context, NodeIndex self) {
  if (!has_to_commit(context, self)) pause_leaf(context, self);
}

double progress_of_committing(NodeContext& context, NodeIndex self) {
  return has_to_commit(context, self) ? 1.0 : progress_of_leaf(context, self);
}

double progress_of_children(NodeContext& context, NodeIndex self) {
  double least = 1.0;
  bool any = false;
  for (NodeIndex child = self + 1; child != context.end_of(self); child = context.end_of(child)) {
    if (context.status(child) != Status::Running) continue;
    least = std::min(least, context.progress(child));
    any = true;
  }
  return any ? least : 0.0;
}

double progress_of_control(NodeContext& context, NodeIndex self) {
  LeafSlot& leaf = context.leaf(self);
  if (leaf.is_out()) return 0.0;
  if (leaf.type->progress == nullptr) return progress_of_children(context, self);
  const Reach reach(leaf, ChildAccess::Look);
  return progress_of_leaf(context, self);
}

}  // namespace

Status LeafCall::complete(NodeContext& context, NodeIndex node, LeafSlot& leaf,
                          lockstep_status result) {
  Status status = meaning_of<Kind::Action>(context, node, leaf, result, false);
  if (context.faulted()) status = Status::Running;
  context.state_.activity[node] = static_cast<Activity>(status);
  context.state_.last_tick[node] = context.state_.tick_number;
  return status;
}

double LeafCall::spoiled_progress(NodeContext& context, NodeIndex node, double reported) {
  LeafSlot& leaf = context.leaf(node);
  if (leaf.failed() || context.faulted()) reported = 0.0;  // as after an exception
  return corrected(context, node, leaf, reported);
}

[[gnu::cold]] double LeafCall::last_progress(const NodeContext& context, NodeIndex node) {
  double last = 0.0;
  HeldLeaves::visit(context.held_leaves_, [&](const auto& all, const auto& /*went_on*/) {
    const auto it = std::ranges::find(all, node, &HeldLeaves::Held::node);
    if (it != all.end()) last = it->most;
  });
  return last;
}

[[gnu::cold]] void LeafCall::note_exception(NodeContext& context, const LeafSlot& leaf) {
  context.set_fault(context.tree().leaves[place_of(context, leaf)].node, describe_exception());
}

// The process may be a forked child; or the tick lasts, and from now on its calls are timed.
[[gnu::cold]] void LeafCall::note_unusual(NodeContext& context, CallMark& mark,
                                          const LeafSlot& leaf, PluginFunction function) {
  ForkGuard::check();
  LeafWatch* const watch = context.watch_;
  if (watch == nullptr || context.timer_ != nullptr) return;
  watch->note_if_rung(place_of(context, leaf), function, mark);
  context.timer_ = watch->timer();
}

std::optional<double> look_at_progress(NodeContext& context, NodeIndex node) {
  LeafSlot& leaf = context.leaf(node);
  if (leaf.kept_progress == nullptr && leaf.type->progress == nullptr) return std::nullopt;
  const char* const error = leaf.error;
  double reported = -1.0;
  if (leaf.kept_progress != nullptr) {
    reported = leaf.read_progress();
  } else {
    const LeafCall around(context, node, leaf, PluginFunction::Progress);
    try {
      reported = leaf.type->progress(leaf.self);
      if (leaf.error != error) reported = -1.0;
    } catch (...) {
      reported = -1.0;
    }
  }
  leaf.set_error(error);
  return reported >= 0.0 && reported <= 1.0 ? std::optional(reported) : std::nullopt;
}

void save_leaf(NodeContext& context, NodeIndex node, std::span<char> room, std::string& into) {
  LeafSlot& leaf = context.leaf(node);
  if (leaf.is_out()) return;
  std::size_t size = 0;
  guarded(context, node, PluginFunction::Save,
          [&](const LeafSlot& it) { size = it.type->save(it.self, room.data(), room.size()); });
  if (take_error(context, node, leaf) || is_out(context, leaf)) return;
  if (size <= room.size()) {
    into.assign(room.data(), size);
  } else {
    context.set_fault(node, "keeps " + std::to_string(size) + " bytes for a checkpoint, at most " +
                                std::to_string(room.size()) + " are kept");
  }
}

AfterCut ask_leaf_after_cut(NodeContext& context, NodeIndex node, std::string_view bytes,
                            const lockstep_cut& cut) {
  LeafSlot& leaf = context.leaf(node);
  lockstep_cut told = cut;
  told.struct_size = sizeof told;
  told.held = context.held(node);
  lockstep_after_cut answer = LOCKSTEP_STARTS_AGAIN;
  guarded(context, node, PluginFunction::Restore, [&](const LeafSlot& it) {
    answer = it.type->restore(it.self, bytes.data(), bytes.size(), &told);
  });
  if (take_error(context, node, leaf) || is_out(context, leaf)) return AfterCut::StartsAgain;
  switch (answer) {
    case LOCKSTEP_STARTS_AGAIN:
      return AfterCut::StartsAgain;
    case LOCKSTEP_CONTINUES:
      return AfterCut::Continues;
    case LOCKSTEP_CANNOT_CONTINUE:
      return AfterCut::Failure;
    default:
      break;
  }
  context.set_fault(node, "returned " + std::to_string(answer) +
                              " from restore, expected a lockstep_after_cut of lockstep/leaf.h");
  return AfterCut::StartsAgain;
}

extern const NodeKind kObeyingAction, kCommittingAction;

const NodeKind kPluginAction{
    .type = {.id = "Action", .category = NodeCategory::Action, .doc = "", .arity = {0, 0}},
    .tick = tick_leaf<Kind::Action, false>,
    .progress = progress_of_leaf,
    .halt = halt_leaf<Kind::Action>,
    .pause = pause_leaf,
    .unreset = unreset_leaf,
    .committing = &kCommittingAction,
    .obeying = &kObeyingAction};

const NodeKind kObeyingAction{
    .type = {.id = "Action", .category = NodeCategory::Action, .doc = "", .arity = {0, 0}},
    .tick = tick_leaf<Kind::Action, true>,
    .progress = progress_of_leaf,
    .state_size = sizeof(LeafPace),
    .halt = halt_leaf<Kind::Action>,
    .pause = pause_leaf,
    .fold = fold::dead_when_idle,
    .unreset = unreset_leaf,
    .taken_up = [](NodeContext& context, NodeIndex self) {
      return context.state<LeafPace>(self).taken;
    }};

const NodeKind kCommittingAction{
    .type = {.id = "Action", .category = NodeCategory::Action, .doc = "", .arity = {0, 0}},
    .tick = tick_committing,
    .progress = progress_of_committing,
    .state_size = sizeof(CommitState),
    .halt = halt_leaf<Kind::Action>,
    .pause = pause_committing,
    .fold = fold::dead_when_idle,
    .unreset = unreset_leaf,
    .taken_up = [](NodeContext& context, NodeIndex self) {
      return context.state<CommitState>(self).pace.taken;
    }};

const NodeKind kPluginCondition{
    .type = {.id = "Condition", .category = NodeCategory::Condition, .doc = "", .arity = {0, 0}},
    .tick = tick_leaf<Kind::Condition, false>,
    .progress = progress_of_leaf,
    .halt = halt_leaf<Kind::Condition>,
    .pause = pause_leaf,
    .unreset = unreset_leaf};

const NodeKind kPluginControl{
    .type = {.id = "Control", .category = NodeCategory::Control, .doc = "", .arity = {1}},
    .tick = tick_control,
    .progress = progress_of_control,
    .halt = halt_leaf<Kind::Control>,
    .pause = pause_control,
    .unreset = unreset_leaf};

}  // namespace lockstep::host

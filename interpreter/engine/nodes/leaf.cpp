// The nodes of plugins, mostly leaves: the only place where the engine calls the C ABI. Whatever
// one does against its contract becomes a fault here. A fault that the
// run goes on after marks the leaf's slot until the activation has ended, with a Failure or a halt.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/plugin_exception.h"
#include "engine/node_kind.h"
#include "engine/ticker.h"
#include "lockstep/leaf.h"

namespace lockstep {
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
void guarded(Ticker& ticker, NodeIndex self, Call call) {
  try {
    call();
  } catch (...) {
    ticker.set_fault(self, describe_exception());
  }
}

// Takes an error that the leaf has set; true if there was one.
bool take_error(Ticker& ticker, NodeIndex self, LeafSlot& leaf) {
  if (leaf.error == nullptr) return false;
  ticker.set_fault(self, leaf.error);
  leaf.error = nullptr;
  return true;
}

void call(Ticker& ticker, NodeIndex self, void (*function)(void*)) {
  LeafSlot& leaf = ticker.leaf(self);
  const Reach reach(leaf, ChildAccess::Look);
  if (function != nullptr) guarded(ticker, self, [&] { function(leaf.self); });
  take_error(ticker, self, leaf);
}

// A control node that halts its children itself; those that it leaves are halted after it.
void halt_before_children(Ticker& ticker, NodeIndex self, LeafSlot& leaf) {
  if (leaf.started && leaf.type->halt != nullptr) {
    const Reach reach(leaf, ChildAccess::Tick);
    guarded(ticker, self, [&] { leaf.type->halt(leaf.self); });
    take_error(ticker, self, leaf);
  }
  ticker.halt_range(self + 1, ticker.end_of(self));
  leaf.failed = false;
}

// Children are halted before their control node.
template <Kind kKind>
void halt_leaf(Ticker& ticker, NodeIndex self) {
  LeafSlot& leaf = ticker.leaf(self);
  if constexpr (kKind == Kind::Control) {
    if ((leaf.type->flags & LOCKSTEP_HALTS_CHILDREN) != 0) {
      return halt_before_children(ticker, self, leaf);
    }
    ticker.halt_range(self + 1, ticker.end_of(self));
    if (ticker.faulted() && !ticker.in_last_halt()) return;  // halted at the end of the run
  }
  if (leaf.started) call(ticker, self, leaf.type->halt);
  leaf.failed = false;
}

// No function of the leaf is called any more but halt, in its time.
bool is_out(const Ticker& ticker, const LeafSlot& leaf) {
  return leaf.failed || ticker.faulted();
}

// What a tick returns once the leaf is out.
template <Kind kKind>
Status out(Ticker& ticker, NodeIndex self) {
  if (ticker.faulted()) return Status::Running;  // halted at the end of the run, in its order
  halt_leaf<kKind>(ticker, self);
  return Status::Failure;
}

[[gnu::noinline]] void start(Ticker& ticker, NodeIndex self, LeafSlot& leaf) {
  leaf.started = false;
  const bool goes_on = std::exchange(leaf.unreset, false);
  call(ticker, self, goes_on ? leaf.type->start_unreset : leaf.type->start);
  leaf.started = !is_out(ticker, leaf);
}

[[gnu::noinline]] void resume(Ticker& ticker, NodeIndex self, LeafSlot& leaf) {
  if (!leaf.failed) call(ticker, self, leaf.type->resume);
}

// The first tick of an activation, or the first after a pause. False: the leaf is out.
bool prepare(Ticker& ticker, NodeIndex self, LeafSlot& leaf) {
  const Activity before = ticker.activity(self);
  if (before == Activity::Running) return !leaf.failed;
  if (before == Activity::Paused) {
    resume(ticker, self, leaf);
  } else if (leaf.type->start == nullptr && !leaf.unreset) {
    leaf.started = true;
  } else {
    start(ticker, self, leaf);
  }
  return !is_out(ticker, leaf);
}

template <Kind kKind>
bool is_result(lockstep_status status) {
  if (kKind == Kind::Condition && status == LOCKSTEP_RUNNING) return false;
  return status > LOCKSTEP_IDLE && status <= static_cast<int>(kLastStatus);
}

// Of a condition.
bool may_run(const LeafSlot& leaf, lockstep_status result) {
  return result == LOCKSTEP_RUNNING && (leaf.type->flags & LOCKSTEP_MAY_RUN) != 0;
}

// What a tick returns that did not go well. Out of line, so that what each tick checks is inline.
template <Kind kKind>
[[gnu::cold, gnu::noinline]] Status spoiled(Ticker& ticker, NodeIndex self, LeafSlot& leaf,
                                            lockstep_status result) {
  if (!take_error(ticker, self, leaf) && !is_out(ticker, leaf) && !may_run(leaf, result)) {
    ticker.set_fault(self, result == LOCKSTEP_RUNNING
                               ? std::string("is a condition and returned running")
                               : "returned status " + std::to_string(result) +
                                     ", expected one of lockstep/leaf.h");
  }
  return leaf.failed ? out<kKind>(ticker, self) : Status::Running;
}

template <Kind kKind>
Status tick_leaf(Ticker& ticker, NodeIndex self) {
  LeafSlot& leaf = ticker.leaf(self);
  if (!prepare(ticker, self, leaf)) [[unlikely]]
    return out<kKind>(ticker, self);
  lockstep_status result = LOCKSTEP_IDLE;  // no result, as after an exception
  bool is_out_now = false;                 // what a node without children reports is its error
  if constexpr (kKind == Kind::Control) {
    const Reach reach(leaf, ChildAccess::Tick);
    guarded(ticker, self, [&] { result = leaf.type->tick(leaf.self); });
    is_out_now = is_out(ticker, leaf);
  } else {
    guarded(ticker, self, [&] { result = leaf.type->tick(leaf.self); });
  }
  if (leaf.error == nullptr && !is_out_now && is_result<kKind>(result)) [[likely]]
    return static_cast<Status>(result);
  return spoiled<kKind>(ticker, self, leaf, result);
}

Status tick_control(Ticker& ticker, NodeIndex self) {
  const Status status = tick_leaf<Kind::Control>(ticker, self);
  if (status != Status::Running) ticker.halt_running_children(self);
  return status;
}

Unreset unreset_leaf(Ticker& ticker, NodeIndex self) {
  LeafSlot& leaf = ticker.leaf(self);
  leaf.unreset = leaf.type->start_unreset != nullptr;
  return leaf.unreset ? Unreset::Begins : unreset_by(*ticker.tree().labels[self].type);
}

void pause(Ticker& ticker, NodeIndex self) {
  LeafSlot& leaf = ticker.leaf(self);
  if (!leaf.failed) call(ticker, self, leaf.type->pause);
}

void pause_leaf(Ticker& ticker, NodeIndex self) {
  pause(ticker, self);
  if (!ticker.faulted()) ticker.watch_held(self);
}

void pause_control(Ticker& ticker, NodeIndex self) {
  for (NodeIndex child = self + 1; child != ticker.end_of(self); child = ticker.end_of(child)) {
    ticker.pause(child);
  }
  if (!ticker.faulted()) pause(ticker, self);
}

double corrected(Ticker& ticker, NodeIndex self, LeafSlot& leaf, double reported) {
  if (take_error(ticker, self, leaf)) return 0.0;
  if (std::isnan(reported)) {
    ticker.set_fault(self, "reported a progress that is not a number");
    return 0.0;
  }
  constexpr double kRounding = 1e-9;  // of a sum of shares; not reported
  if (reported < -kRounding || reported > 1 + kRounding) ticker.note_out_of_range(self, reported);
  return std::clamp(reported, 0.0, 1.0);
}

double progress_of_leaf(Ticker& ticker, NodeIndex self) {
  LeafSlot& leaf = ticker.leaf(self);
  if (leaf.type->progress == nullptr || leaf.failed) return 0.0;
  double reported = 0.0;
  guarded(ticker, self, [&] { reported = leaf.type->progress(leaf.self); });
  if (leaf.error == nullptr && reported >= 0.0 && reported <= 1.0) [[likely]]
    return reported;
  return corrected(ticker, self, leaf, reported);
}

double progress_of_children(Ticker& ticker, NodeIndex self) {
  double least = 1.0;
  bool any = false;
  for (NodeIndex child = self + 1; child != ticker.end_of(self); child = ticker.end_of(child)) {
    if (ticker.status(child) != Status::Running) continue;
    least = std::min(least, ticker.progress(child));
    any = true;
  }
  return any ? least : 0.0;
}

double progress_of_control(Ticker& ticker, NodeIndex self) {
  LeafSlot& leaf = ticker.leaf(self);
  if (leaf.failed) return 0.0;
  if (leaf.type->progress == nullptr) return progress_of_children(ticker, self);
  const Reach reach(leaf, ChildAccess::Look);
  return progress_of_leaf(ticker, self);
}

}  // namespace

std::optional<double> look_at_progress(LeafSlot& leaf) {
  if (leaf.type->progress == nullptr) return std::nullopt;
  const char* const error = leaf.error;
  double reported = -1.0;
  try {
    reported = leaf.type->progress(leaf.self);
    if (leaf.error != error) reported = -1.0;
  } catch (...) {
    reported = -1.0;
  }
  leaf.error = error;
  return reported >= 0.0 && reported <= 1.0 ? std::optional(reported) : std::nullopt;
}

const NodeKind kPluginAction{
    .type = {.id = "Action", .category = NodeCategory::Action, .doc = "", .arity = {0, 0}},
    .tick = tick_leaf<Kind::Action>,
    .progress = progress_of_leaf,
    .halt = halt_leaf<Kind::Action>,
    .pause = pause_leaf,
    .unreset = unreset_leaf};

const NodeKind kPluginCondition{
    .type = {.id = "Condition", .category = NodeCategory::Condition, .doc = "", .arity = {0, 0}},
    .tick = tick_leaf<Kind::Condition>,
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

}  // namespace lockstep

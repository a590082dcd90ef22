// The nodes of plugins, mostly leaves: the only place where the engine calls the C ABI. Whatever
// one does against its contract becomes a fault here. A fault that the run goes on after marks the
// leaf's slot until the activation has ended, with a Failure or a halt.
#include <algorithm>
#include <cmath>
#include <string>

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
  Reach(Ticker& ticker, NodeIndex self, ChildAccess access) : leaf_(ticker.leaf(self)) {
    leaf_.ticker = &ticker;
    leaf_.node = self;
    leaf_.access = access;
  }
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
  const Reach reach(ticker, self, ChildAccess::Look);
  if (function != nullptr) guarded(ticker, self, [&] { function(leaf.self); });
  take_error(ticker, self, leaf);
}

// Children are halted before their control node.
template <Kind kKind>
void halt(Ticker& ticker, NodeIndex self) {
  LeafSlot& leaf = ticker.leaf(self);
  if constexpr (kKind == Kind::Control) {
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
  halt<kKind>(ticker, self);
  return Status::Failure;
}

// The first tick of an activation, or the first after a pause.
void prepare(Ticker& ticker, NodeIndex self, LeafSlot& leaf) {
  if (ticker.activity(self) == Activity::Paused) {
    if (!leaf.failed) call(ticker, self, leaf.type->resume);
  } else if (leaf.type->start == nullptr) {
    leaf.started = true;
  } else {
    leaf.started = false;
    call(ticker, self, leaf.type->start);
    leaf.started = !is_out(ticker, leaf);
  }
}

// Out of line, so that what each tick checks stays inline.
[[gnu::cold, gnu::noinline]] void refuse(Ticker& ticker, NodeIndex self, lockstep_status result) {
  ticker.set_fault(self, result == LOCKSTEP_RUNNING
                             ? std::string("is a condition and returned running")
                             : "returned status " + std::to_string(result) +
                                   ", expected one of lockstep/leaf.h");
}

// Running when the leaf is out.
template <Kind kKind>
Status checked(Ticker& ticker, NodeIndex self, LeafSlot& leaf, lockstep_status result) {
  if (leaf.error != nullptr) [[unlikely]] {
    take_error(ticker, self, leaf);
    return Status::Running;
  }
  if (is_out(ticker, leaf)) return Status::Running;
  const bool is_status = result > LOCKSTEP_IDLE && result <= static_cast<int>(kLastStatus);
  if (is_status && (kKind != Kind::Condition || result != LOCKSTEP_RUNNING)) [[likely]] {
    return static_cast<Status>(result);
  }
  refuse(ticker, self, result);
  return Status::Running;
}

template <Kind kKind>
Status tick(Ticker& ticker, NodeIndex self) {
  LeafSlot& leaf = ticker.leaf(self);
  if (ticker.activity(self) != Activity::Running) prepare(ticker, self, leaf);
  if (is_out(ticker, leaf)) return out<kKind>(ticker, self);
  lockstep_status result = LOCKSTEP_RUNNING;
  guarded(ticker, self, [&] { result = leaf.type->tick(leaf.self); });
  const Status status = checked<kKind>(ticker, self, leaf, result);
  return leaf.failed ? out<kKind>(ticker, self) : status;
}

Status tick_control(Ticker& ticker, NodeIndex self) {
  LeafSlot& leaf = ticker.leaf(self);
  if (ticker.activity(self) != Activity::Running) prepare(ticker, self, leaf);
  if (is_out(ticker, leaf)) return out<Kind::Control>(ticker, self);
  lockstep_status result = LOCKSTEP_RUNNING;
  {
    const Reach reach(ticker, self, ChildAccess::Tick);
    guarded(ticker, self, [&] { result = leaf.type->tick(leaf.self); });
  }
  const Status status = checked<Kind::Control>(ticker, self, leaf, result);
  if (leaf.failed) return out<Kind::Control>(ticker, self);
  if (status != Status::Running) ticker.halt_running_children(self);
  return status;
}

void pause(Ticker& ticker, NodeIndex self) {
  LeafSlot& leaf = ticker.leaf(self);
  if (!leaf.failed) call(ticker, self, leaf.type->pause);
}

void pause_control(Ticker& ticker, NodeIndex self) {
  for (const NodeIndex child : ticker.leaf(self).children) ticker.pause(child);
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

double progress(Ticker& ticker, NodeIndex self) {
  LeafSlot& leaf = ticker.leaf(self);
  if (leaf.type->progress == nullptr || leaf.failed) return 0.0;
  double reported = 0.0;
  guarded(ticker, self, [&] { reported = leaf.type->progress(leaf.self); });
  if (leaf.error == nullptr && reported >= 0.0 && reported <= 1.0) [[likely]]
    return reported;
  return corrected(ticker, self, leaf, reported);
}

double progress_of_children(Ticker& ticker, const LeafSlot& leaf) {
  double least = 1.0;
  bool any = false;
  for (const NodeIndex child : leaf.children) {
    if (ticker.status(child) != Status::Running) continue;
    least = std::min(least, ticker.progress(child));
    any = true;
  }
  return any ? least : 0.0;
}

double progress_of_control(Ticker& ticker, NodeIndex self) {
  const LeafSlot& leaf = ticker.leaf(self);
  if (leaf.failed) return 0.0;
  if (leaf.type->progress == nullptr) return progress_of_children(ticker, leaf);
  const Reach reach(ticker, self, ChildAccess::Look);
  return progress(ticker, self);
}

}  // namespace

const NodeKind kPluginAction{
    .type = {.id = "Action", .category = NodeCategory::Action, .doc = "", .arity = {0, 0}},
    .tick = tick<Kind::Action>,
    .progress = progress,
    .halt = halt<Kind::Action>,
    .pause = pause};

const NodeKind kPluginCondition{
    .type = {.id = "Condition", .category = NodeCategory::Condition, .doc = "", .arity = {0, 0}},
    .tick = tick<Kind::Condition>,
    .progress = progress,
    .halt = halt<Kind::Condition>,
    .pause = pause};

const NodeKind kPluginControl{
    .type = {.id = "Control", .category = NodeCategory::Control, .doc = "", .arity = {1}},
    .tick = tick_control,
    .progress = progress_of_control,
    .halt = halt<Kind::Control>,
    .pause = pause_control};

}  // namespace lockstep

// The stand-ins for nodes that no plugin has: an action and a condition return what they are given
// (NodeType::mock), a control node is a sequence, a decorator passes on.
#include "base/core/time_progress.h"
#include "engine/node_ports.h"
#include "engine/nodes/decorator.h"
#include "engine/nodes/fold.h"
#include "engine/nodes/timed.h"
#include "engine/tree.h"

namespace lockstep::host {
namespace {

const Mock& mock_of(const NodeContext& context, NodeIndex self) {
  return *context.tree().labels[self].type->mock;
}

// What an entry cannot have is not written. One without a type keeps none: the leaf may have
// another one.
void write(Entry& entry, const Value& value) {
  if (entry.is_present && entry.typing == Typing::Any) {
    entry.assign(value);
  } else {
    (void)write_entry(entry, static_cast<ValueType>(value.index()), nullptr, value);
  }
}

Status result_of(NodeContext& context, NodeIndex self) {
  const Mock& mock = mock_of(context, self);
  if (mock.result != Status::Success) return mock.result;
  for (unsigned port = 0; port < mock.outputs.size(); ++port) {
    if (std::holds_alternative<NoValue>(mock.outputs[port])) continue;
    if (Entry* const entry = context.ports().entry(self, port)) write(*entry, mock.outputs[port]);
  }
  return mock.result;
}

Nanoseconds time_of_mock(const NodeContext& context, NodeIndex self) {
  return from_seconds(mock_of(context, self).seconds);
}

Status tick_mock_action(NodeContext& context, NodeIndex self) {
  timed::count(context, self);
  const Nanoseconds counted = context.passed(context.state<timed::State>(self).start);
  return counted >= time_of_mock(context, self) ? result_of(context, self) : Status::Running;
}

void fold_mock_action(NodeContext& context, NodeIndex self) {
  fold::dead_when_idle(context, self);
  if (context.status(self) != Status::Running) return;
  timed::count_from_now(context, self, true, time_of_mock(context, self));
}

double action_progress(NodeContext& context, NodeIndex self) {
  return progress_of_time(timed::counted(context, self), time_of_mock(context, self),
                          context.deadlines());
}

Status tick_mock_condition(NodeContext& context, NodeIndex self) {
  return result_of(context, self);
}

double condition_progress(NodeContext& /*context*/, NodeIndex /*self*/) {
  return 0;
}

struct ControlState {
  NodeIndex child;
  std::uint32_t done;
};

Status tick_mock_control(NodeContext& context, NodeIndex self) {
  auto& state = context.state<ControlState>(self);
  if (context.first_tick(self)) state = {self + 1, 0};
  for (; state.child != context.end_of(self); state.child = context.end_of(state.child)) {
    const Status status = context.tick(state.child);
    if (status == Status::Running || status == Status::Failure) return status;
    ++state.done;
  }
  return Status::Success;
}

double control_progress(NodeContext& context, NodeIndex self) {
  const auto& state = context.state<ControlState>(self);
  const double here = state.child == context.end_of(self) ? 0 : context.progress(state.child);
  return (state.done + here) / context.node(self).children;
}

Status tick_mock_decorator(NodeContext& context, NodeIndex self) {
  return context.tick(self + 1);
}

}  // namespace

const NodeKind kMockAction{
    .type = {.id = "", .category = NodeCategory::Action, .doc = "", .can_run = true},
    .tick = tick_mock_action,
    .progress = action_progress,
    .state_size = sizeof(timed::State),
    .pause = timed::pause,
    .fold = fold_mock_action,
    .reads_own_hold = true};
const NodeKind kMockCondition{.type = {.id = "", .category = NodeCategory::Condition, .doc = ""},
                              .tick = tick_mock_condition,
                              .progress = condition_progress};
const NodeKind kMockControl{.type = {.id = "", .category = NodeCategory::Control, .doc = ""},
                            .tick = tick_mock_control,
                            .progress = control_progress,
                            .state_size = sizeof(ControlState),
                            .fold = fold::dead_when_idle};
const NodeKind kMockDecorator{.type = {.id = "", .category = NodeCategory::Decorator, .doc = ""},
                              .tick = tick_mock_decorator,
                              .progress = decorator::child_progress};

}  // namespace lockstep::host

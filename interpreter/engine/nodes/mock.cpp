// What a stand-in for a node that no plugin has does: an action and a condition return what they
// are given (NodeType::mock), a control node is a sequence, a decorator passes on.
#include <algorithm>

#include "engine/nodes/decorator.h"
#include "engine/nodes/fold.h"
#include "engine/nodes/timed.h"

namespace lockstep {
namespace {

const Mock& mock_of(const Ticker& ticker, NodeIndex self) {
  return *ticker.tree().labels[self].type->mock;
}

Status tick_mock_action(Ticker& ticker, NodeIndex self) {
  timed::count(ticker, self);
  const Mock& mock = mock_of(ticker, self);
  const Nanoseconds counted = ticker.now() - ticker.state<timed::State>(self).start;
  return counted >= from_seconds(mock.seconds) ? mock.result : Status::Running;
}

void fold_mock_action(Ticker& ticker, NodeIndex self) {
  fold::dead_when_idle(ticker, self);
  if (ticker.status(self) != Status::Running) return;
  timed::count_from_now(ticker, self, true, from_seconds(mock_of(ticker, self).seconds));
}

double action_progress(Ticker& ticker, NodeIndex self) {
  const auto& state = ticker.state<timed::State>(self);
  const bool paused = ticker.activity(self) == Activity::Paused;
  const Nanoseconds counted = (paused ? state.paused_at : ticker.now()) - state.start;
  const double seconds = mock_of(ticker, self).seconds;
  return seconds > 0 ? std::min(1.0, to_seconds(counted) / seconds) : 1.0;
}

Status tick_mock_condition(Ticker& ticker, NodeIndex self) {
  return mock_of(ticker, self).result;
}

double condition_progress(Ticker& /*ticker*/, NodeIndex /*self*/) {
  return 0;
}

struct ControlState {
  NodeIndex child;
  std::uint32_t done;
};

Status tick_mock_control(Ticker& ticker, NodeIndex self) {
  auto& state = ticker.state<ControlState>(self);
  if (ticker.first_tick(self)) state = {self + 1, 0};
  for (; state.child != ticker.end_of(self); state.child = ticker.end_of(state.child)) {
    const Status status = ticker.tick(state.child);
    if (status == Status::Running || status == Status::Failure) return status;
    ++state.done;
  }
  return Status::Success;
}

double control_progress(Ticker& ticker, NodeIndex self) {
  const auto& state = ticker.state<ControlState>(self);
  const double here = state.child == ticker.end_of(self) ? 0 : ticker.progress(state.child);
  return (state.done + here) / ticker.node(self).children;
}

Status tick_mock_decorator(Ticker& ticker, NodeIndex self) {
  return ticker.tick(self + 1);
}

}  // namespace

const NodeKind kMockAction{
    .type = {.id = "", .category = NodeCategory::Action, .doc = "", .can_run = true},
    .tick = tick_mock_action,
    .progress = action_progress,
    .state_size = sizeof(timed::State),
    .pause = timed::pause,
    .fold = fold_mock_action};
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

}  // namespace lockstep

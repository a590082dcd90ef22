// Repeat and RetryUntilSuccessful of BehaviorTree.CPP.
#include <algorithm>

#include "dialect/btcpp/nodes/kinds.h"
#include "engine/bound_node.h"
#include "engine/nodes/decorator.h"
#include "engine/nodes/fold.h"

namespace lockstep::host::btcpp {
namespace {

constexpr std::int64_t kEndless = -1;

constexpr Parameter kRepeatParameters[] = {
    {.name = "num_cycles",
     .type = ValueType::Int,
     .doc = "How often the child must succeed; -1: without limit.",
     .required = true}};
constexpr Parameter kRetryParameters[] = {
    {.name = "num_attempts",
     .type = ValueType::Int,
     .doc = "How often the child may fail before the node fails; -1: without limit.",
     .required = true}};

// The rounds that are over. Kept while the child is skipped, so not cleared by a first tick.
struct RepeatState {
  std::int64_t done;
};

// A child that completed at once lets the tree be ticked again; another one is ticked again here.
template <Status kGoOn>
Status tick_repeat(NodeContext& context, NodeIndex self) {
  RepeatState& state = context.state<RepeatState>(self);
  const auto has_more = [&] {
    const std::int64_t times = context.parameter(self, 0).integer;
    return times == kEndless || state.done < times;
  };
  for (bool is_again = false; has_more(); is_again = true) {
    if (is_again) context.begin_again(self + 1);
    const bool was_idle = context.first_tick(self + 1);
    const Status status = context.tick(self + 1);
    if (status == Status::Skipped) context.forget_range(self + 1, context.end_of(self));
    if (status == Status::Running || status == Status::Skipped) return status;
    if (status != kGoOn) {
      state.done = 0;
      return status;
    }
    ++state.done;
    if (kGoOn == Status::Failure && !reread(context, self)) return Status::Failure;
    if (was_idle && has_more()) {
      context.ask_for_another_tick(self);
      return Status::Running;
    }
  }
  state.done = 0;
  return kGoOn;
}

void forget_repeat(NodeContext& context, NodeIndex self) {
  context.state<RepeatState>(self).done = 0;
}

// How often does not matter for ever.
void fold_repeat(NodeContext& context, NodeIndex self) {
  const bool is_endless = context.parameter(self, 0).integer == kEndless;
  if (is_endless && context.parameters().are_fixed(self)) fold::dead(context, self);
}

double progress_of_repeat(NodeContext& context, NodeIndex self) {
  const std::int64_t times = context.parameter(self, 0).integer;
  const double child =
      context.status(self + 1) == Status::Running ? context.progress(self + 1) : 0.0;
  if (times <= 0) return child;
  const auto done = static_cast<double>(context.state<RepeatState>(self).done);
  return std::min(1.0, (done + child) / static_cast<double>(times));
}

Round round_of_repeat(NodeContext& context, NodeIndex self) {
  const std::int64_t times = context.parameter(self, 0).integer;
  return {context.state<RepeatState>(self).done + 1, std::max(times, std::int64_t{0})};
}

}  // namespace

const NodeKind kRepeat{
    .type = {.id = "Repeat",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child until it has succeeded num_cycles times; Failure as soon as "
                    "it fails.",
             .arity = {1, 1},
             .parameters = kRepeatParameters,
             .progress_share = ProgressShare::EachRound,
             .repeats_after = Status::Success,
             .can_run = true},
    .tick = tick_repeat<Status::Success>,
    .progress = progress_of_repeat,
    .state_size = sizeof(RepeatState),
    .halt = forget_repeat,
    .forget = forget_repeat,
    .fold = fold_repeat,
    .round = round_of_repeat};

const NodeKind kRetryUntilSuccessful{
    .type = {.id = "RetryUntilSuccessful",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child until it succeeds; Failure when it has failed num_attempts "
                    "times.",
             .arity = {1, 1},
             .parameters = kRetryParameters,
             .repeats_after = Status::Failure,
             .can_run = true},
    .tick = tick_repeat<Status::Failure>,
    .progress = decorator::child_progress,  // of this attempt
    .state_size = sizeof(RepeatState),
    .halt = forget_repeat,
    .forget = forget_repeat,
    .fold = fold_repeat,
    .round = round_of_repeat};

}  // namespace lockstep::host::btcpp

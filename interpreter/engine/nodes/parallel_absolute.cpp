#include "engine/nodes/barrier_list.h"
#include "engine/nodes/fold.h"
#include "engine/nodes/kinds.h"
#include "engine/nodes/synchronized_tick.h"

namespace lockstep::host {
namespace {

constexpr parallel::Counts kAbsoluteCounts{.success_count = 3, .failure_count = 4};

constexpr Parameter kAbsoluteParameters[] = {
    absolute::kBarriersParameter,
    absolute::kBarrierCountParameter,
    absolute::kAtBarrierParameter,
    parallel::kSuccessCount,
    parallel::kFailureCount,
    parallel::kMemory,
    kHoldParameter,
    pacing::kPace,
    pacing::kReaction,
};
constexpr unsigned kAbsolutePace = 7;

std::optional<RuleBreak> rule_of_absolute(const ParameterValues& given) {
  if (auto broken = parallel::check_counts(given, kAbsoluteCounts)) return broken;
  if (auto broken = pacing::check(given, kAbsolutePace)) return broken;
  if (!given.is_given(absolute::kBarriers) && !given.is_given(absolute::kBarrierCount)) {
    return RuleBreak{-1, "'barriers' or 'barrier_count' is missing",
                     "give exactly one of the two, such as barriers=\"0.25;0.5;0.75\""};
  }
  return absolute::check_barriers(given);
}

template <bool kPaces>
Status tick_absolute(NodeContext& context, NodeIndex self) {
  const auto barriers = context.parameters().numbers(self, absolute::kBarriers);
  const double least = synchronized::take_snapshot(context, self);
  auto& state = context.state<SynchronizedState>(self);
  const double barrier = absolute::current_barrier(barriers, least, state.place);
  state.limit = barrier;
  const bool ticks = context.parameter(self, absolute::kAtBarrier).integer == kTicksAtBarrier;
  const double held_from = absolute::held_from(barrier, ticks);
  return synchronized::tick_up_to<kPaces>(context, self, kAbsoluteCounts, barrier, held_from,
                                          kAbsolutePace);
}

extern const NodeKind kPacedAbsolute;

}  // namespace

const NodeKind kParallelAbsolute{
    .type = {.id = "ParallelAbsolute",
             .category = NodeCategory::Control,
             .doc = "Ticks its children in parallel and makes them wait for each other at a list "
                    "of barriers: a child that has reached the current barrier is held until all "
                    "have. Ends as "
                    "Parallel does.",
             .arity = {1},
             .parameters = kAbsoluteParameters,
             .rule = rule_of_absolute,
             .sign = "⇉A",
             .synchronization = Synchronization::Absolute,
             .holding = {.barriers = absolute::kBarriers,
                         .at_barrier = absolute::kAtBarrier,
                         .hold = 6},
             .latches = true},
    .tick = tick_absolute<false>,
    .progress = synchronized::least_progress,
    .state_size = sizeof(SynchronizedState),
    .state_per_child = sizeof(double),
    .fold = fold::dead,
    .paced = &kPacedAbsolute,
    .if_moved = IfMoved::Same,
    .has_any_order = true,
    .sure_to_end = parallel::sure_to_end<kAbsoluteCounts>};

namespace {
const NodeKind kPacedAbsolute = synchronized::paced_kind(kParallelAbsolute, tick_absolute<true>);
}  // namespace

}  // namespace lockstep::host

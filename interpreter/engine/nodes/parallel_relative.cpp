#include "engine/nodes/fold.h"
#include "engine/nodes/kinds.h"
#include "engine/nodes/synchronized_tick.h"

namespace lockstep::host {
namespace {

constexpr unsigned kDelta = 0;
constexpr parallel::Counts kRelativeCounts{.success_count = 1, .failure_count = 2};

constexpr Parameter kRelativeParameters[] = {
    {.name = "delta",
     .type = ValueType::Double,
     .doc = "How far a child may be ahead of the slowest and still be ticked: 0 = strict lockstep, "
            "1 = not synchronized.",
     .required = true,
     .range = {.min = 0, .max = 1}},
    parallel::kSuccessCount,
    parallel::kFailureCount,
    parallel::kMemory,
    kHoldParameter,
    pacing::kPace,
    pacing::kReaction,
};
constexpr unsigned kRelativePace = 5;

std::optional<RuleBreak> rule_of_relative(const ParameterValues& given) {
  if (auto broken = parallel::check_counts(given, kRelativeCounts)) return broken;
  return pacing::check(given, kRelativePace);
}

template <bool kPaces>
Status tick_relative(NodeContext& context, NodeIndex self) {
  const double least = synchronized::take_snapshot(context, self);
  const double delta = context.parameter(self, kDelta).number;
  context.state<SynchronizedState>(self).limit = delta;
  const double most = farthest(Synchronization::Relative, delta, least);
  const double held_from = least_above(most);
  return synchronized::tick_up_to<kPaces>(context, self, kRelativeCounts, most, held_from,
                                          kRelativePace);
}

extern const NodeKind kPacedRelative;

}  // namespace

const NodeKind kParallelRelative{
    .type = {.id = "ParallelRelative",
             .category = NodeCategory::Control,
             .doc = "Ticks its children in parallel and holds those that are ahead of the slowest "
                    "by more than delta. Ends as Parallel does.",
             .arity = {1},
             .parameters = kRelativeParameters,
             .rule = rule_of_relative,
             .sign = "⇉R",
             .synchronization = Synchronization::Relative,
             .holding = {.delta = kDelta, .hold = 4},
             .latches = true},
    .tick = tick_relative<false>,
    .progress = synchronized::least_progress,
    .state_size = sizeof(SynchronizedState),
    .state_per_child = sizeof(double),
    .fold = fold::dead,
    .paced = &kPacedRelative,
    .if_moved = IfMoved::Same,
    .has_any_order = true,
    .sure_to_end = parallel::sure_to_end<kRelativeCounts>};

namespace {
const NodeKind kPacedRelative = synchronized::paced_kind(kParallelRelative, tick_relative<true>);
}  // namespace

}  // namespace lockstep::host

#include "engine/leaf_loop.h"
#include "engine/nodes/fold.h"
#include "engine/nodes/kinds.h"
#include "engine/nodes/parallel_rule.h"

namespace lockstep::host {
namespace {

constexpr parallel::Counts kParallelCounts{.success_count = 0, .failure_count = 1};

constexpr Parameter kParallelParameters[] = {parallel::kSuccessCount, parallel::kFailureCount,
                                             parallel::kMemory};

Status tick_parallel(NodeContext& context, NodeIndex self) {
  const NodeIndex end = context.end_of(self);
  parallel::Tally tally;
  for (NodeIndex child = self + 1; child != end;) {
    auto [stop, status] = LeafLoop::tick<Status::Running>(context, child, end);
    if (stop == end) break;
    child = context.end_of(stop);
    if (status == Status::Idle) {
      status = parallel::is_over(context, stop) ? context.status(stop) : context.tick(stop);
    }
    tally.add(status);
  }
  return parallel::judge(context, self, kParallelCounts, tally);
}

double progress_of_parallel(NodeContext& context, NodeIndex self) {
  return parallel::progress_of_mth(context, self,
                                   context.parameter(self, kParallelCounts.success_count).integer);
}

}  // namespace

const NodeKind kParallel{
    .type = {.id = "Parallel",
             .category = NodeCategory::Control,
             .doc = "Ticks all children that have not completed, and those without actions in "
                    "every tick. Success when success_count of them succeeded; Failure when "
                    "failure_count failed, or when success can no longer be reached. The children "
                    "that still run are then halted.",
             .arity = {1},
             .parameters = kParallelParameters,
             .rule = parallel::rule<kParallelCounts>,
             .sign = "⇉",
             .latches = true},
    .tick = tick_parallel,
    .progress = progress_of_parallel,
    .state_per_child = sizeof(double),
    .fold = fold::dead,
    .if_moved = IfMoved::Same,
    .has_any_order = true,
    .sure_to_end = parallel::sure_to_end<kParallelCounts>};

}  // namespace lockstep::host

// SkipUnlessUpdated, WaitValueUpdate and WasEntryUpdated: whether an entry was written, also with
// the value that it had, since the node looked last.
#include "dialect/btcpp/nodes/kinds.h"
#include "engine/node_ports.h"
#include "engine/nodes/at_once.h"
#include "engine/nodes/decorator.h"
#include "engine/nodes/fold.h"

namespace lockstep::host::btcpp {
namespace {

constexpr unsigned kEntry = 0;

constexpr Parameter kUpdatedParameters[] = {{.name = "entry",
                                             .type = ValueType::String,
                                             .doc = "The entry to look at.",
                                             .required = true,
                                             .names_entry = true}};

struct UpdatedState {
  std::uint32_t seen;  // Entry::writes
  bool runs;           // the child was ticked and has not completed
};

bool was_written(NodeContext& context, NodeIndex self, UpdatedState& state) {
  const Entry* entry = context.ports().entry(self, kEntry);
  if (entry == nullptr || !entry->is_present || entry->writes() == state.seen) return false;
  state.seen = entry->writes();
  return true;
}

template <Status kElse>
Status tick_updated(NodeContext& context, NodeIndex self) {
  UpdatedState& state = context.state<UpdatedState>(self);
  if (!state.runs && !was_written(context, self, state)) return kElse;
  const Status status = context.tick(self + 1);
  state.runs = status == Status::Running;
  return status;
}

void halt_updated(NodeContext& context, NodeIndex self) {
  context.state<UpdatedState>(self).runs = false;
}

Status tick_condition(NodeContext& context, NodeIndex self) {
  const bool written = was_written(context, self, context.state<UpdatedState>(self));
  return written ? Status::Success : Status::Failure;
}

}  // namespace

const NodeKind kSkipUnlessUpdated{.type = {.id = "SkipUnlessUpdated",
                                           .category = NodeCategory::Decorator,
                                           .doc = "Ticks its child when the entry was written "
                                                  "since the last time; otherwise it is skipped.",
                                           .arity = {1, 1},
                                           .parameters = kUpdatedParameters,
                                           .reads_ports = true},
                                  .tick = tick_updated<Status::Skipped>,
                                  .progress = decorator::child_progress,
                                  .state_size = sizeof(UpdatedState),
                                  .halt = halt_updated,
                                  .fold = fold::live,
                                  .counts_writes = true};

const NodeKind kWaitValueUpdate{
    .type = {.id = "WaitValueUpdate",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child when the entry was written since the last time; Running until "
                    "then.",
             .arity = {1, 1},
             .parameters = kUpdatedParameters,
             .can_run = true,
             .reads_ports = true},
    .tick = tick_updated<Status::Running>,
    .progress = decorator::child_progress,
    .state_size = sizeof(UpdatedState),
    .halt = halt_updated,
    .fold = fold::live,
    .counts_writes = true};

const NodeKind kWasEntryUpdated{
    .type = {.id = "WasEntryUpdated",
             .category = NodeCategory::Condition,
             .doc = "Success when the entry was written since the last tick of this node.",
             .arity = {0, 0},
             .parameters = kUpdatedParameters,
             .reads_ports = true},
    .tick = tick_condition,
    .progress = no_progress,
    .state_size = sizeof(UpdatedState),
    .fold = fold::live,
    .counts_writes = true};

}  // namespace lockstep::host::btcpp

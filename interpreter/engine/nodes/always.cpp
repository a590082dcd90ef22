// AlwaysSuccess, AlwaysFailure, AlwaysRunning: leaves with one answer.
#include "engine/nodes/at_once.h"
#include "engine/nodes/kinds.h"

namespace lockstep::host {
namespace {

template <Status kStatus>
Status tick_always(NodeContext&, NodeIndex) {
  return kStatus;
}

}  // namespace

const NodeKind kAlwaysSuccess{.type = {.id = "AlwaysSuccess",
                                       .category = NodeCategory::Action,
                                       .doc = "Success at once.",
                                       .arity = {0, 0},
                                       .again = Again::ReturnsResult},
                              .tick = tick_always<Status::Success>,
                              .progress = no_progress};

const NodeKind kAlwaysFailure{.type = {.id = "AlwaysFailure",
                                       .category = NodeCategory::Action,
                                       .doc = "Failure at once.",
                                       .arity = {0, 0},
                                       .again = Again::ReturnsResult},
                              .tick = tick_always<Status::Failure>,
                              .progress = no_progress};

const NodeKind kAlwaysRunning{.type = {.id = "AlwaysRunning",
                                       .category = NodeCategory::Action,
                                       .doc = "Running until it is halted; its progress is 0.",
                                       .arity = {0, 0},
                                       .again = Again::ReturnsResult,
                                       .can_run = true,
                                       .has_progress = false},
                              .tick = tick_always<Status::Running>,
                              .progress = no_progress};

}  // namespace lockstep::host

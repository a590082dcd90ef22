#include "embedding/node_calls.h"

#include <fmt/format.h>

namespace lockstep::host::embedding {

std::optional<Status> NodeCalls::before_tick(NodeIndex node) {
  const Status status = context_.status(node);
  const auto decided = call(node, LOCKSTEP_BEFORE_TICK, status);
  if (!decided || *decided != Status::Running) return decided;
  context_.set_fault(node, "its watcher returned running before its tick, which is not a result");
  return Status::Failure;
}

std::optional<Status> NodeCalls::after_tick(NodeIndex node, Status status) {
  const auto decided = call(node, LOCKSTEP_AFTER_TICK, status);
  if (!decided || *decided == status || *decided != Status::Running) return decided;
  context_.set_fault(node, "who watches it has returned running for a node that has ended");
  return std::nullopt;
}

std::optional<Status> NodeCalls::call(NodeIndex node, int32_t what, Status status) {
  const auto known = static_cast<lockstep_status>(status);
  const InLeaf scope(context_.blackboard().lock.get());
  const lockstep_status given = call_(user_, &run_, node, what, known);
  if (given == LOCKSTEP_IDLE) return std::nullopt;
  if (given > LOCKSTEP_IDLE && given <= static_cast<lockstep_status>(kLastStatus)) {
    return static_cast<Status>(given);
  }
  context_.set_fault(node, fmt::format("who watches it has returned status {}, expected one of "
                                       "lockstep/leaf.h",
                                       static_cast<int>(given)));
  return std::nullopt;
}

}  // namespace lockstep::host::embedding

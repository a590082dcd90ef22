#include "embedding/node_calls.h"

#include <fmt/format.h>

namespace lockstep::host::embedding {

std::optional<Status> NodeCalls::before_tick(NodeIndex node) {
  const Status status = context_.status(node);
  const auto decided = call(node, LOCKSTEP_BEFORE_TICK, status);
  if (!decided || *decided != Status::Running) return decided;
  return fail(node, status, "its watcher returned running before its tick, which is not a result");
}

std::optional<Status> NodeCalls::after_tick(NodeIndex node, Status status) {
  const auto decided = call(node, LOCKSTEP_AFTER_TICK, status);
  if (!decided || *decided == status || *decided != Status::Running) return decided;
  return fail(node, status, "who watches it has returned running for a node that has ended");
}

std::optional<Status> NodeCalls::call(NodeIndex node, int32_t what, Status status) {
  const auto known = static_cast<lockstep_status>(status);
  const InLeaf scope(context_.blackboard().lock.get());
  const lockstep_status given = call_(user_, &run_, node, what, known);
  if (given == LOCKSTEP_IDLE) return std::nullopt;
  if (given > LOCKSTEP_IDLE && given <= static_cast<lockstep_status>(kLastStatus)) {
    return static_cast<Status>(given);
  }
  return fail(
      node, status,
      fmt::format("who watches it has returned status {}, expected one of lockstep/leaf.h", given));
}

Status NodeCalls::fail(NodeIndex node, Status status, std::string message) {
  context_.set_fault_around(node, status == Status::Running, std::move(message));
  return Status::Failure;
}

}  // namespace lockstep::host::embedding

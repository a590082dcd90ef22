// Tells a program of its nodes while they are ticked: lockstep_run_watch_nodes. Only within
// embedding/.
#pragma once

#include <optional>
#include <string>

#include "embedding/lockstep/runtime.h"
#include "engine/blackboard.h"
#include "engine/node_context.h"
#include "engine/node_watch.h"

namespace lockstep::host::embedding {

class NodeCalls final : public NodeWatch {
 public:
  NodeCalls(lockstep_run& run, NodeContext& context) : run_(run), context_(context) {}
  void set(lockstep_watch_node watch, void* user) {
    call_ = watch;
    user_ = user;
  }

  std::optional<Status> before_tick(NodeIndex node) override;
  std::optional<Status> after_tick(NodeIndex node, Status status) override;
  void before_halt(NodeIndex node) override { tell(node, LOCKSTEP_BEFORE_HALT); }
  void after_halt(NodeIndex node) override { tell(node, LOCKSTEP_AFTER_HALT); }

 private:
  void tell(NodeIndex node, int32_t what) {
    const InLeaf scope(context_.blackboard().lock.get());
    call_(user_, &run_, node, what, LOCKSTEP_IDLE);
  }
  std::optional<Status> call(NodeIndex node, int32_t what, Status status);
  // A fault, or a Failure that the run continues after.
  Status fail(NodeIndex node, Status status, std::string message);

  lockstep_run& run_;
  NodeContext& context_;
  lockstep_watch_node call_ = nullptr;
  void* user_ = nullptr;
};

}  // namespace lockstep::host::embedding

// Shows a tree in Groot2 while it is ticked.
#pragma once

#include <chrono>
#include <memory>

#include "behaviortree_cpp/bt_factory.h"

namespace BT {
namespace lockstep_detail {

inline const bool groot_was_included = groot_is_wanted = true;

}  // namespace lockstep_detail

// On two ports of this machine, which any other reaches that reaches this one. Groot2 looks at the
// tree and at its entries; it cannot change them or stop the tree.
class Groot2Publisher {
 public:
  explicit Groot2Publisher(const Tree& tree, unsigned server_port = 1667);
  ~Groot2Publisher();
  Groot2Publisher(const Groot2Publisher&) = delete;
  Groot2Publisher& operator=(const Groot2Publisher&) = delete;

  // Connections need no heartbeat here: one that is idle costs nothing.
  void setMaxHeartbeatDelay(std::chrono::milliseconds delay) { heartbeat_ = delay; }
  std::chrono::milliseconds maxHeartbeatDelay() const { return heartbeat_; }

 private:
  std::weak_ptr<lockstep_detail::Program> program_;
  std::chrono::milliseconds heartbeat_{5000};
};

}  // namespace BT

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/groot2_publisher.h"  // IWYU pragma: export
#endif

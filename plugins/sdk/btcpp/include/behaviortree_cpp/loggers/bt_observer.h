// Not in lockstep: the compiler says what to use instead.
#pragma once

#include "behaviortree_cpp/bt_factory.h"

namespace BT {

class TreeObserver {
 public:
  struct NodeStatistics {
    NodeStatus last_result, current_status;
    unsigned transitions_count, success_count, failure_count, skip_count;
    Duration last_timestamp;
  };
  template <class Node>
  const NodeStatistics& getStatistics(const Node&) const;
  const std::unordered_map<std::uint16_t, NodeStatistics>& statistics() const;
  const std::unordered_map<std::string, std::uint16_t>& pathToUID() const;
  const std::map<std::uint16_t, std::string>& uidToPath() const;
  void resetStatistics();

  template <class... Arguments>
  explicit TreeObserver(Arguments&&...) {
    static_assert(
        sizeof...(Arguments) > 1000,
        "lockstep has no TreeObserver: 'lockstep log' counts the results of each node of a "
        "recording; lockstep_run_observe() of lockstep/runtime.h calls a function after each tick");
  }
};

}  // namespace BT

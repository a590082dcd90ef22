// Groot2's picture of the statuses of nodes: the present ones, and the changes while it records. A
// node is known by its uid, which counts from 1 in pre-order.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "base/core/clock.h"
#include "base/core/status.h"
#include "trace/node_state.h"

namespace lockstep::host {

// It has 16 bits.
constexpr std::size_t kMostGrootNodes = 65'535;
constexpr std::uint16_t groot_uid(NodeIndex node) {
  return static_cast<std::uint16_t>(node + 1);
}

class GrootStatuses {
 public:
  static constexpr std::size_t kMostTransitions = 1000;

  // Keeps the statuses of these nodes, in this order.
  explicit GrootStatuses(std::span<const NodeIndex> order);

  // At this time of the run.
  void change(NodeIndex node, Status status, Nanoseconds time);
  // The uid and the status of each node, in 3 bytes.
  const std::string& bytes() const { return bytes_; }

  // Forgets the changes so far; their times count from `now`.
  void start_recording(Nanoseconds now);
  void stop_recording() { is_recording_ = false; }
  // The last changes since they were taken, 9 bytes each: µs, uid, status.
  std::string take_transitions();

 private:
  struct Transition {
    std::uint64_t time;  // µs
    std::uint16_t uid;
    Status status;
  };

  std::string bytes_;
  std::vector<std::size_t> places_;  // in `bytes_`, of the status of each node
  Nanoseconds start_{0};
  bool is_recording_ = false;
  std::deque<Transition> transitions_;
};

}  // namespace lockstep::host

// Passes the statuses of nodes from the tick thread to another one: what each tick has changed,
// into a ring of fixed size. What does not fit is passed on with the next tick.
#pragma once

#include <cstdint>
#include <vector>

#include "record/live/packet_ring.h"
#include "trace/observer.h"
#include "trace/shape.h"

namespace lockstep::host {

class StatusFeed final : public Observer {
 public:
  explicit StatusFeed(const Shape& shape);

  AskedOfRun asked() const override { return {.within = true}; }
  void after_tick(const Moment& moment, const TickReport& report) override;

  // For one other thread: visits the changes since the last call, in order, as whole ticks.
  template <class Visit>  // (NodeIndex, Status, Nanoseconds)
  void take(Visit visit) {
    const std::uint64_t end = ring_.pushed();
    ring_.each_packet(ring_.taken(), end, [&](std::uint64_t position, const PacketHead& head) {
      ring_.each_node(position, head.nodes, [&](const NodeChange& it) {
        visit(it.node, status_of(it.activity()), Nanoseconds(head.time));
      });
    });
    ring_.take_until(end);
  }

 private:
  template <class ActivityOf>
  void pass_on(ActivityOf activity_of, const TickReport& report);

  std::vector<Activity> passed_on_;  // of each node
  std::vector<NodeState> moment_;
  std::vector<NodeChange> changes_;  // for its room
  PacketRing ring_;
};

}  // namespace lockstep::host

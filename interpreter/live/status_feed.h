// Passes the statuses of nodes from the tick thread to another one: what each tick has changed,
// into a ring of fixed size. What does not fit is passed on with the next tick.
#pragma once

#include <cstdint>
#include <vector>

#include "live/packet_ring.h"
#include "runtime/observer.h"

namespace lockstep {

class StatusFeed final : public Observer {
 public:
  explicit StatusFeed(const Tree& tree);

  void after_tick(Ticker& ticker, const TickReport& report) override;

  // For one other thread: visits the changes since the last call, in order, as whole ticks.
  template <class Visit>  // (NodeIndex, Status, Nanoseconds)
  void take(Visit visit) {
    for (std::uint64_t at = ring_.taken(); at != ring_.pushed();) {
      const PacketHead head = ring_.head(at);
      std::uint64_t place = at + sizeof head;
      for (std::uint64_t left = head.nodes; left > 0;) {
        const auto nodes = ring_.nodes(place, left);
        for (const NodeChange& it : nodes) {
          visit(it.node, status_of(it.activity()), Nanoseconds(head.time));
        }
        left -= nodes.size();
        place += nodes.size_bytes();
      }
      at += PacketRing::in_cells(packet_size(head));
      ring_.take_until(at);
    }
  }

 private:
  std::vector<std::uint8_t> passed_on_;  // the Activity of each node
  std::vector<NodeChange> changes_;      // for its room
  PacketRing ring_;
};

}  // namespace lockstep

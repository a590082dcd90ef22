// How often the nodes of a run completed, were halted and held, had faults, and how often entries
// got another value: counted from what is sent to listeners, for those that miss some of it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/json_reader.h"
#include "live/packet_ring.h"

namespace lockstep {

class EventCounts {
 public:
  // Counts the ticks of a ring from one position to another. Of each line that has the whole state,
  // `counted` gets what was counted up to it, as a part of this line.
  void take(const PacketRing& ring, std::uint64_t from, std::uint64_t to,
            std::vector<std::string>& counted);

 private:
  enum Count : std::size_t { kSuccess, kFailure, kSkipped, kHalted, kHeld, kFault, kCounts };
  using Counts = std::array<std::uint64_t, kCounts>;

  struct Node {
    Counts counts{};
    std::uint64_t since = 0;  // the tick with which it became as it is
    std::uint64_t named = 0;  // in which of the ticks that were taken, the last time
    std::uint8_t state = 0;   // as in NodeChange

    // Before this tick.
    Counts until(std::uint64_t tick) const;
  };

  struct Entry {
    std::uint64_t values = 0;
    bool is_long = false;  // the last
    std::string value = {};
  };

  bool take_tick(const PacketRing& ring, std::uint64_t position, const PacketHead& head);
  void take_node(const NodeChange& change, std::uint64_t tick);
  void take_text(std::string text);
  void take_fault(JsonValue fault);
  void take_entry(JsonValue entry);
  std::string text(std::uint64_t tick) const;

  JsonReader reader_;
  std::vector<Node> nodes_;
  std::vector<Entry> entries_;
  std::uint64_t tick_ = 0;  // how many were taken
};

}  // namespace lockstep

// How often the nodes of a run completed, were halted and held, had faults, and how often entries
// got another value: counted from what is sent to listeners, for those that miss some of it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "record/live/packet_ring.h"
#include "record/live/tick_end_json.h"
#include "trace/moments_view.h"

namespace lockstep::host {

class EventCounts {
 public:
  // The first ones are those of NodeTotals.
  enum Count : std::size_t { kSuccess, kFailure, kSkipped, kHalted, kHeld, kFault, kCounts };
  using Counts = std::array<std::uint64_t, kCounts>;

  EventCounts();

  // Counts the ticks of a ring from one position to another. Of each line that has the whole state,
  // `counted` gets what was counted up to it, as a part of this line.
  void take(const PacketRing& ring, std::uint64_t from, std::uint64_t to,
            std::vector<std::string>& counted);

  // --- for the reader of an end
  // ----------------------------------------------------------------------------

  // The end of a tick's line. No value: it is too long.
  void take_fault(NodeIndex node);
  void take_entry(std::size_t entry, std::optional<std::string_view> value);
  // Of its moments, in their order: first what they differ from the one after them.
  void take_moment_node(NodeIndex node, NodeState state) {
    moment_changes_.push_back({.node = node, .before = state});
  }
  void take_moment(std::uint64_t times) {
    moments_.push_back({times, static_cast<std::uint32_t>(moment_changes_.size())});
  }
  void take_more(const NodeTotals& totals) { more_.push_back(totals); }

  std::size_t nodes() const { return nodes_.size(); }
  Counts of_node(std::size_t node, std::uint64_t tick) const {
    return nodes_[node].until(tick + 1);
  }
  std::size_t entries() const { return entries_.size(); }
  // How many values it has had.
  std::uint64_t of_entry(std::size_t entry) const { return entries_[entry].values; }

 private:
  struct Node {
    Counts counts{}, settled{};
    std::uint64_t since = 0;  // the tick with which it became as it is
    std::uint64_t named = 0;  // in which of the packets that were taken, the last time
    std::uint8_t state = 0;   // as in NodeChange

    // Before this tick.
    Counts until(std::uint64_t tick) const;
  };

  struct Entry {
    std::uint64_t values = 0;
    std::optional<std::string> value = {};  // the last
  };

  bool take_tick(const PacketRing& ring, std::uint64_t position, const PacketHead& head);
  void take_node(const NodeChange& change, std::uint64_t tick);
  void settle(std::uint64_t tick);
  void take_moments(std::uint64_t tick);

  TickEndJson reader_;
  std::string empty_end_;  // of a tick of which there is nothing but nodes to tell
  std::vector<Node> nodes_;
  std::vector<Entry> entries_;
  std::vector<TickMoment> moments_;  // of the tick that is taken
  std::vector<MomentChange> moment_changes_;
  std::vector<NodeTotals> more_;
  std::vector<NodeState> before_, first_moment_, moment_;
  std::uint64_t packet_ = 0;                // how many ticks were taken, each as often as it came
  std::optional<std::uint64_t> last_ = {};  // the number of the last tick
};

}  // namespace lockstep::host

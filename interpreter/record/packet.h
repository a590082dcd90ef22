// The numbers that the tick thread passes to the threads of those who watch, which print or count
// them: to print a number takes far longer than to copy it, and a tick has no time for that. They
// are plain data, so that a crash handler can print what is still in the ring. Only in the memory
// of one process, never in a file.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include "trace/node_state.h"

namespace lockstep::host {

// The part of a tick's line about one node.
struct NodeChange {
  static constexpr std::uint8_t kTicked = NodeState::kTicked;

  double progress = 0;
  NodeIndex node = 0;
  std::uint8_t state = 0;  // as NodeState

  Activity activity() const { return NodeState{state}.activity(); }
  bool ticked() const { return NodeState{state}.ticked(); }
};

// The part of a tick's line about the limit of a synchronized node (base/core/synchronization.h).
struct LimitChange {
  NodeIndex node = 0;
  double limit = 0;
};

// How fast a node is to be that is paced (engine/pace.h).
struct FactorChange {
  NodeIndex node = 0;
  double factor = 1;
};

// What a leaf gives as the reason of its result, or "": none any more (trace/reason.h).
struct ReasonChange {
  std::size_t place = 0;  // in Moment::reasons
  NodeIndex node = 0;
  std::string_view text = {};
};

// The round of a node that repeats its child; number 0: it is not running.
struct RoundChange {
  NodeIndex node = 0;
  Round round = {};
};

struct PacketHead {
  std::uint64_t lost = 0, lost_from = 0;  // a line before all else, if there are lost ticks
  std::uint64_t tick = 0;
  std::int64_t time = 0;    // ns
  std::uint64_t text = 0;   // bytes; push() sets it
  std::uint32_t nodes = 0;  // how many, likewise
  std::uint16_t is_tick = 0;
  std::uint16_t begins_part = 0;  // a tick with the whole state, the first in another file
};

// After the head come the changes of nodes, then text as it is in the file: for a tick what
// json_lines::set_tick_end made, otherwise whole lines.
struct Packet {
  PacketHead head = {};
  std::span<const NodeChange> nodes = {};
  std::string_view text = {};
};

// Packets in the ring begin at multiples of this size, so a change is never split at its end.
constexpr std::size_t kPacketCell = 16;
static_assert(sizeof(NodeChange) == kPacketCell && sizeof(PacketHead) % kPacketCell == 0);
static_assert(alignof(NodeChange) <= kPacketCell &&
              kPacketCell <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);  // the ring's
static_assert(std::is_trivially_copyable_v<NodeChange> && std::is_trivially_copyable_v<PacketHead>);

// Without the cells' padding.
constexpr std::uint64_t packet_size(std::uint64_t nodes, std::uint64_t text) {
  return sizeof(PacketHead) + sizeof(NodeChange) * nodes + text;
}
constexpr std::uint64_t packet_size(const PacketHead& head) {
  return packet_size(head.nodes, head.text);
}
constexpr std::uint64_t packet_size(const Packet& packet) {
  return packet_size(packet.nodes.size(), packet.text.size());
}

}  // namespace lockstep::host

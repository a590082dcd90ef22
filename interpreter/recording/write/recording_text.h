// The pieces of a recording's lines that are written in every tick. The put functions are
// async-signal-safe: they write into the caller's memory and return the end. Used by packet_printer
// and recorder.
#pragma once

#include <span>
#include <string>

#include "core/clock.h"
#include "engine/ticker.h"
#include "recording/recording.h"
#include "recording/write/entry_changes.h"
#include "recording/write/recording_packet.h"

namespace lockstep {

// {"lost":{"ticks":2,"from":7}} and the end of the line.
constexpr std::size_t kMostOfLost = 80;
char* put_lost(char* to, std::uint64_t ticks, std::uint64_t from);

// {"tick":3,"time_s":0.03,"nodes":[ with the exact time, where a double would say
// 0.030000000000000002.
constexpr std::size_t kMostOfTick = 80;
char* put_tick(char* to, std::uint64_t tick, Nanoseconds time);

// [3,"running",0.25,1,0]. The longest: [4294967295,"success",0.00012345678901234567,1,0] and a
// comma.
constexpr std::size_t kMostOfNode = 64;
char* put_node(char* to, NodeIndex node, const RecordedState& state);

// What ends a tick's line, after its nodes.
struct TickEnd {
  std::span<const LimitChange> limits = {};
  std::span<const NodeIndex> succeeded = {};
  std::span<const Fault> faults = {};
  std::span<const EntryChange> entries = {};
  std::span<const RecordedLog> logs = {};
};

// ]} or ],"limits":[[1,0.5]],"succeeded":[1],"faults":[[3,"threw …"],…],… } and a newline; of a
// long message only the beginning. Replaces `text`; allocates for faults, logs and texts that JSON
// has to escape, and where `text` has no room.
void set_tick_end(std::string& text, const TickEnd& end);
// The most that this is without those, and with entries that are numbers.
constexpr std::size_t most_of_tick_end(std::size_t synchronized_nodes, std::size_t entries) {
  return 64 + 64 * (synchronized_nodes + entries);
}

}  // namespace lockstep

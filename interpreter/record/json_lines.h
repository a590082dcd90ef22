// How a run is written: what comes between the packets of the tick thread and the bytes of a
// recording, as JSON Lines (docs/recording.md). Functions without state: threads share them, and a
// crash handler calls them again.
//
// A recording consists of lines. Each function gives whole lines, but a tick's line is put_tick,
// put_nodes in any number of calls, then what set_tick_end made: where a disk is full, the file
// ends after a '\n'.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/core/clock.h"
#include "judge/measure/entry_changes.h"
#include "record/header_and_end.h"
#include "record/packet.h"
#include "trace/answer.h"
#include "trace/faults.h"
#include "trace/moment.h"
#include "trace/moments_view.h"

namespace lockstep::host {

// The facts of a tick besides its nodes.
struct TickEnd {
  std::span<const LimitChange> limits = {};
  std::span<const RoundChange> rounds = {};
  std::span<const FactorChange> factors = {};
  std::span<const ReasonChange> reasons = {};
  std::span<const GivenAnswer> answers = {};
  std::span<const Heard> heard = {};
  std::span<const NodeIndex> succeeded = {};
  MomentsView moments = {};
  std::span<const Fault> faults = {};
  std::span<const EntryChange> entries = {};
  std::span<const LeafLine> logs = {};
  bool is_full = false;  // the line has the whole state; nothing before it counts
  // The line also has the whole state: this is what is not above, each entry that has a value.
  std::optional<std::span<const EntryChange>> whole = {};
};

namespace json_lines {

// The most that the put functions may write at once: put_lost and put_tick together, one node.
constexpr std::size_t kMostAtOnce = 512;

// --- on the tick thread; what they return waits in the ring as it is -----------------------------

std::string header(const RecordingHeader& header);
std::string end(const RecordedEnd& end);
// Replaces `text`. Allocates only for faults, logs, reasons, answers and texts of entries, and
// where `text` has less room than most_of_tick_end.
void set_tick_end(std::string& text, const TickEnd& end);
// For a tree of so many nodes, of which so many have a limit or a round.
std::size_t most_of_tick_end(std::size_t nodes, std::size_t limits, std::size_t entries);

// --- on the writing thread or in a crash handler: async-signal-safe
// ------------------------------- They write to the caller's memory and return the end. The same
// call gives the same bytes.

char* put_lost(char* to, std::uint64_t ticks, std::uint64_t from);
char* put_tick(char* to, std::uint64_t tick, Nanoseconds time);
struct Put {
  char* end;
  std::size_t count;  // of the nodes: those that fit, at least one if there is kMostAtOnce
};
Put put_nodes(std::span<char> room, std::span<const NodeChange> nodes, bool first);

// --- on the writing thread, for a recording in parts
// ----------------------------------------------

// The header of a later part.
// The tick after a line of a tick, or of lost ones.
std::optional<std::uint64_t> next_tick_of(std::string_view line);
// A line with a gap of these ticks.
std::string lost(std::uint64_t ticks, std::uint64_t from);
std::string part_header(std::string_view header, std::uint64_t first_tick);
// The last line of a part: the run goes on in another one, and had so many ticks before it.
std::string part_end(std::uint64_t ticks);

// --- for listeners, who begin in the middle of a run and may miss lines
// ---------------------------

// The tick of a line; none: it is a line of another kind.
std::optional<std::uint64_t> tick_of(std::string_view line);
bool is_last(std::string_view line);
// How each line ends that has the whole state, and no other: no text in a line has a line end.
constexpr std::string_view kFullEnd = ",\"full\":true}\n";

}  // namespace json_lines
}  // namespace lockstep::host

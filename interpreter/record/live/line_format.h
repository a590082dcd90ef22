// How a run is written: what comes between the packets of the tick thread and the bytes of a
// recording. A format is a file that implements this; record/write/json_lines.h is the one that
// exists. A format has no state: an object of it is shared by threads and used again after a crash.
//
// A recording consists of lines. Each function below except the last two gives whole lines, and the
// last two together give one: where a disk is full, the file ends after a '\n'.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/core/clock.h"
#include "engine/ticker.h"
#include "judge/measure/entry_changes.h"
#include "record/live/header_and_end.h"
#include "record/live/packet.h"

namespace lockstep::host {

// The facts of a tick besides its nodes.
struct TickEnd {
  std::span<const LimitChange> limits = {};
  std::span<const RoundChange> rounds = {};
  std::span<const NodeIndex> succeeded = {};
  MomentsView moments = {};
  std::span<const Fault> faults = {};
  std::span<const EntryChange> entries = {};
  std::span<const LeafLine> logs = {};
  bool is_full = false;  // the line has the whole state; nothing before it counts
  // The line also has the whole state: this is what is not above, each entry that has a value.
  std::optional<std::span<const EntryChange>> whole = {};
};

class LineFormat {
 public:
  // The most that the put functions may write at once: put_lost and put_tick together, one node.
  static constexpr std::size_t kMostAtOnce = 512;

  // --- on the tick thread; what they return waits in the ring as it is
  // ----------------------------

  virtual std::string header(const RecordingHeader& header) const = 0;
  virtual std::string end(const RecordedEnd& end) const = 0;
  // Replaces `text`. Allocates only for faults, logs and texts of entries, and where `text` has
  // less room than most_of_tick_end.
  virtual void set_tick_end(std::string& text, const TickEnd& end) const = 0;
  // For a tree of so many nodes, of which so many have a limit or a round.
  virtual std::size_t most_of_tick_end(std::size_t nodes, std::size_t limits,
                                       std::size_t entries) const = 0;

  // --- on the writing thread or in a crash handler: async-signal-safe
  // ----------------------------- They write to the caller's memory and return the end. The same
  // call gives the same bytes.

  virtual char* put_lost(char* to, std::uint64_t ticks, std::uint64_t from) const = 0;
  // Each tick is written as its beginning, its nodes in any number of calls, then what set_tick_end
  // made.
  virtual char* put_tick(char* to, std::uint64_t tick, Nanoseconds time) const = 0;
  struct Put {
    char* end;
    std::size_t count;  // of the nodes: those that fit, at least one if there is kMostAtOnce
  };
  virtual Put put_nodes(std::span<char> room, std::span<const NodeChange> nodes,
                        bool first) const = 0;

  // --- on the writing thread, for a recording in parts
  // -----------------------------------------------

  // The header of a later part.
  virtual std::string part_header(std::string_view header, std::uint64_t first_tick) const = 0;
  // The last line of a part: the run goes on in another one, and had so many ticks before it.
  virtual std::string part_end(std::uint64_t ticks) const = 0;

 protected:
  ~LineFormat() = default;
};

}  // namespace lockstep::host

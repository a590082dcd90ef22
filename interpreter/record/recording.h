// The content of a recording, as data. docs/recording.md describes the format. The recorder writes
// it, the reader reads it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/core/clock.h"
#include "base/core/status.h"
#include "record/header_and_end.h"
#include "trace/moment.h"

namespace lockstep::host {

// The state of one node in one tick. Before the first tick all nodes are as constructed here.
struct RecordedState {
  double progress = 0;  // at the start of the tick, as its parent used it
  // The limit of a synchronized node (engine/synchronized.h) or of a UseResources
  // (engine/resources.h).
  double limit = 0;
  double factor = 1;             // of what is paced: trace/moment.h
  Round round = {};              // of a node that repeats its child; number 0: not running
  Status status = Status::Idle;  // after the tick
  bool ticked = false;
  bool held = false;

  NodeState state() const {
    return NodeState::of(held ? Activity::Paused : static_cast<Activity>(status), ticked);
  }

  friend bool operator==(const RecordedState&, const RecordedState&) = default;
};

// A fault of a leaf after which the run went on.
struct RecordedFault {
  NodeIndex node = 0;
  std::string message;

  friend bool operator==(const RecordedFault&, const RecordedFault&) = default;
};

// A leaf whose reason differs from the line before; "": it gives none any more.
struct RecordedReason {
  NodeIndex node = 0;
  std::string text;

  friend bool operator==(const RecordedReason&, const RecordedReason&) = default;
};

// A node that stands for another robot and has heard a new word since the line before: Heard.
struct RecordedHeard {
  NodeIndex node = 0;
  std::uint32_t run = 0;
  std::uint64_t word = 0;  // 0: the process is new, and has heard none yet
};

inline bool operator==(const Heard& one, const Heard& other) {
  return one.node == other.node && one.run == other.run && one.word == other.word &&
         one.time == other.time;
}
// Takes what a tick at `time` has heard to what was heard before, one for each node. A word that a
// line with the whole state repeats keeps its time.
void take_heard(std::span<const RecordedHeard> words, Nanoseconds time, std::vector<Heard>& heard);

// A blackboard entry whose value differs from the line before.
struct RecordedEntry {
  std::uint32_t entry = 0;           // in RecordingHeader::entries
  std::optional<std::string> value;  // as text; none: too long to be shown

  friend bool operator==(const RecordedEntry&, const RecordedEntry&) = default;
};

// Its value, or that it is too long.
std::string shown_value(const RecordedEntry& entry);

struct RecordedTick {
  std::uint64_t tick = 0;
  double time = 0;  // seconds
  std::span<const RecordedState> nodes;
  // That the line names: all others are as after the tick before. May have one more than once.
  std::span<const NodeIndex> changed = {};
  // Synchronized nodes, and children of parallels, that an ancestor has ended since.
  std::span<const NodeIndex> succeeded = {};
  MomentsView moments = {};
  std::span<const RecordedReason> reasons = {};
  std::span<const GivenAnswer> answers = {};
  std::span<const RecordedHeard> heard = {};
  std::span<const RecordedFault> faults = {};
  std::span<const RecordedEntry> entries = {};
  std::span<const std::uint32_t> set = {};    // of these: written since the tick before, too
  std::span<const RecordedEntry> given = {};  // what they had then, if the tick wrote them again
  std::span<const LeafLine> logs = {};
  // The line has the whole state: each entry that has a value.
  std::optional<std::span<const RecordedEntry>> whole = {};
};

// Ticks in a row that have no line: the disk was too slow for them.
struct RecordedGap {
  std::uint64_t ticks = 0;
  std::uint64_t from = 0;  // the first
};

// The end of a file, after which the run goes on in another one.
struct RecordedPartEnd {
  std::uint64_t ticks = 0;  // of the run until then
};

// "Sequence", "ParallelAbsolute barriers=0.25;0.5".
std::string kind_text(const ShapeNode& node);
// From one tick to the next; 0 when the rate is not known.
Nanoseconds period_of(const RecordingHeader& header);

}  // namespace lockstep::host

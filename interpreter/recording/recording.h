// The content of a recording, as data. docs/recording.md describes the format. The recorder writes
// it, the reader reads it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/clock.h"
#include "core/status.h"
#include "engine/node_kind.h"
#include "engine/synchronized.h"
#include "runtime/leaf_lines.h"

namespace lockstep {

constexpr int kRecordingVersion = 1;

struct RecordedNode {
  std::string path, kind, name;
  std::optional<NodeIndex> parent;  // none: the root
  Synchronization synchronization = Synchronization::None;
  std::optional<std::vector<double>> barriers;  // Absolute; none: an entry gives them
  std::optional<double> delta;                  // Relative; likewise
  std::vector<std::string> resources = {};      // of a pool
  std::vector<NodeIndex> members = {};          // of a group, which has no parent: what they hold
  bool ignores_idle = false;                    // a group that leaves out who is idle
};

struct RecordedKey {
  std::string key, type;                // of a blackboard entry
  std::vector<NodeIndex> writers = {};  // the nodes that may write it; readers leave it out
};

struct RecordingHeader {
  std::string tree;       // the id of the tree
  std::string file;       // as the user named it
  std::string version;    // of the program
  std::uint64_t law = 1;  // of the program: core/language.h; recordings of the first do not name it
  double rate_hz = 0;
  std::string clock;  // "wall" or "virtual"
  std::uint64_t seed = 0;
  std::map<std::string, std::string, std::less<>> arguments;
  std::vector<RecordedNode> nodes;        // by index: pre-order
  std::vector<RecordedKey> entries = {};  // those that the recording shows
};

// The state of one node in one tick. Before the first tick all nodes are as constructed here.
struct RecordedState {
  double progress = 0;  // at the start of the tick, as its parent used it
  // Of a synchronized node: engine/synchronized.h; of a UseResources: engine/resources.h.
  double limit = 0;
  Round round = {};              // of a node that repeats its child; number 0: not running
  Status status = Status::Idle;  // after the tick
  bool ticked = false;
  bool held = false;

  friend bool operator==(const RecordedState&, const RecordedState&) = default;
};

// Of a leaf; the run went on after it.
struct RecordedFault {
  NodeIndex node = 0;
  std::string message;

  friend bool operator==(const RecordedFault&, const RecordedFault&) = default;
};

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
  std::span<const NodeIndex> succeeded = {};  // synchronized, that an ancestor has ended since
  std::span<const RecordedFault> faults = {};
  std::span<const RecordedEntry> entries = {};
  std::span<const LeafLine> logs = {};
};

// Ticks in a row that have no line: the disk was too slow for them.
struct RecordedGap {
  std::uint64_t ticks = 0;
  std::uint64_t from = 0;  // the first
};

struct RecordedEnd {
  std::string result, reason;
  std::string fault;  // or ""
  std::optional<std::uint64_t> signal;
  std::uint64_t ticks = 0;
  double time = 0;  // seconds
  std::uint64_t overruns = 0, skipped = 0;
  std::uint64_t lost = 0;  // ticks that have no line
  std::vector<std::string> notes = {};
  std::vector<LeafLine> logs = {};  // after the last tick, as in halts
};

// The header's part about the nodes.
std::vector<RecordedNode> describe(const Tree& tree);
// "Sequence", "ParallelAbsolute barriers=0.25;0.5".
std::string kind_text(const RecordedNode& node);
// By index: whether the node uses resources of a pool.
std::vector<bool> resource_users(const RecordingHeader& header);
// From one tick to the next; 0 when the rate is not known.
Nanoseconds period_of(const RecordingHeader& header);

}  // namespace lockstep

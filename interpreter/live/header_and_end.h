// The facts about a run before its first tick and after its last.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/node_type.h"
#include "engine/node_kind.h"
#include "engine/tree.h"
#include "runtime/leaf_lines.h"

namespace lockstep::host {

struct RecordedNode {
  std::string path, kind, name;
  std::optional<NodeIndex> parent = {};  // none: the root
  Synchronization synchronization = Synchronization::None;
  std::optional<std::vector<double>> barriers = {};  // Absolute; none: an entry gives them
  std::optional<double> delta = {};                  // Relative; likewise
  std::vector<std::string> resources = {};           // of a pool
  std::vector<NodeIndex> members = {};  // of a group, which has no parent: what they hold
  bool ignores_idle = false;            // a group that leaves out who is idle
  bool is_guard = false;                // a child of a parallel, or in a member, without an action
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
  std::map<std::string, std::string, std::less<>> arguments = {};
  std::map<std::string, std::string, std::less<>> values = {};  // that entries start with
  std::vector<RecordedNode> nodes = {};                         // by index: pre-order
  std::vector<RecordedKey> entries = {};                        // those that the recording shows
  std::uint64_t first_tick = 0;  // of a recording in parts, in this part
  std::string verify = {};       // what verify has found; "": it is any other run
};

struct RecordedEnd {
  std::string result, reason;
  std::string fault;  // or ""
  std::optional<std::uint64_t> signal = {};
  std::uint64_t ticks = 0;
  double time = 0;  // seconds
  std::uint64_t overruns = 0, skipped = 0;
  std::uint64_t lost = 0;  // ticks that have no line
  std::vector<std::string> notes = {};
  std::vector<LeafLine> logs = {};  // after the last tick, as in halts
};

// The header's part about the nodes.
std::vector<RecordedNode> describe(const Tree& tree);

}  // namespace lockstep::host

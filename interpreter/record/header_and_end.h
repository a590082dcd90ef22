// The facts about a run before its first tick and after its last.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "run/leaf_lines.h"
#include "trace/shape.h"

namespace lockstep::host {

// The root is ticked once a period, also when a node asks for another tick.
inline constexpr std::string_view kExactlyOnce = "exactly-once";

// Also the shape of the tree, with the entries that the recording shows.
struct RecordingHeader : Shape {
  std::string file;     // as the user named it
  std::string version;  // of the program
  std::uint64_t law =
      1;  // of the program: base/core/language.h; recordings of the first do not name it
  double rate_hz = 0;
  std::string clock;  // "wall" or "virtual"
  std::uint64_t seed = 0;
  std::map<std::string, std::string, std::less<>> arguments = {};
  std::map<std::string, std::string, std::less<>> values = {};  // that entries start with
  std::uint64_t first_tick = 0;  // of a recording in parts, in this part
  // Of the first part after a cut: seconds since the state was saved from which the run continues.
  std::optional<double> resumed_after = {};
  std::string verify = {};  // what verify has found; "": it is any other run
  std::string tick = {};    // kExactlyOnce, or ""
  std::uint64_t run = 0;    // of a robot in a team: what others call this run; 0: it is in none
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

}  // namespace lockstep::host

// The content of a recording, as packets: the header, the changes of a tick, the end. The caller
// decides where they go, and which ticks get one. A tick allocates only for lines that leaves log,
// for faults, and for entries whose text grows. Used by recorder and by the web monitor.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "judge/measure/entry_changes.h"
#include "record/header_and_end.h"
#include "record/live/run_delta.h"
#include "record/packet.h"
#include "run/leaf_lines.h"
#include "trace/observer.h"

namespace lockstep::host {

struct RunDescription {
  std::string tree_file;  // as the user named it
  double rate_hz = 0;
  std::uint64_t seed = 0;
  std::map<std::string, std::string, std::less<>> arguments = {};
  std::map<std::string, std::string, std::less<>> values = {};  // that entries start with
  std::optional<std::vector<std::string>> entries = {};         // of these keys; none: all
  std::string verify = {};                                      // what it shows, of a run of verify
  bool exactly_once = false;
  std::uint64_t run = 0;  // RecordingHeader::run
  // Questions and answers have values of entries, so they are left out with those.
  bool leaves_out_answers = false;
};

class RunPackets {
 public:
  RunPackets(Shape shape, RunDescription run);

  std::string header(const RunStart& start) const;

  // Call before the first tick: what came before this is no change.
  void begin(const Moment& moment, std::span<const std::uint32_t> set = {});
  // Before a tick that is to become a packet: asks every running node for its progress.
  void before_tick(const Moment& moment);
  // The changes since the last packet that was kept. Valid until the next call.
  Packet tick(const Moment& moment, const TickReport& report);
  // The last packet has more than other progress: a node begins, completes, is held, goes on or is
  // ticked again, or there is a limit, a round, a fault, an entry or a line of a leaf.
  bool has_events() const { return has_events_; }
  // A node has begun in it.
  bool has_begun() const { return delta_.has_begun(); }
  // The next packet also has the whole state, until one is kept: a reader may begin there.
  void add_whole();
  // The last packet was accepted.
  void keep();
  // The next packet has the whole state, as if nothing had been kept, and says so.
  void start_over();

  std::string end(const Moment& moment, const RunEnd& end, std::uint64_t lost);

  // Takes a line that a leaf has logged. May be called from any thread.
  void log(std::string_view who, std::string_view level, std::string_view text);

 private:
  std::vector<ShapeEntry> entries_shown() const;
  std::map<std::string, std::string, std::less<>> start_values() const;

  const Shape shape_;
  const RunDescription run_;
  std::span<const ReasonChange> reasons(const Moment& moment);

  RunDelta delta_;
  std::vector<std::uint32_t> slots_;  // of the entries that are shown
  EntryChanges entries_;
  LeafLines lines_;
  std::vector<ReasonChange> reasons_;  // those that may be recorded
  std::string line_end_;               // of the tick, for its room
  // The number of the last tick that tick() was called for, or of that before the first.
  std::optional<std::uint32_t> looked_ = {};
  bool is_full_ = false, is_whole_ = false;
  bool has_events_ = false;
};

}  // namespace lockstep::host

// Writes a run to a file, of each tick what changed: docs/recording.md. On a virtual clock the same
// run gives the same bytes. Does not allocate per tick, leaves printing to the writing thread, and
// on a real clock never waits for the disk: ticks for which there is no room are left out and
// counted, and the recording reports them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "record/live/run_packets.h"
#include "record/write/append_file.h"
#include "trace/observer.h"

namespace lockstep::host {

// When another file is begun: with the first tick after so much. 0: never for that reason.
struct Rotation {
  std::uint64_t bytes = 0;               // on the disk
  Nanoseconds time{0};                   // of the run
  std::uint64_t keep = 0;                // of the files, the last ones; 0: all
  std::vector<std::string> before = {};  // files of the same run, in their order: they count, too

  bool is_wanted() const { return bytes > 0 || time.count() > 0; }
};

struct RecorderOptions {
  std::string path;  // of the recording
  RunDescription run;
  // Called once, on the tick thread, when the recording cannot be written. Nothing is written after
  // it; whether the run goes on is the caller's choice.
  std::function<void(const std::string& error)> on_error = {};
  std::uint64_t whole_each = 4096;         // ticks: so often a line has the whole state
  std::size_t queue = AppendFile::kQueue;  // bytes that may wait for the disk, at least
  bool compresses = false;                 // with zstd; a path that ends in .zst says so, too
  Rotation rotation = {};
  MakeEncoder encoder = {};  // makes another format of it
};

class Recorder final : public Observer {
 public:
  Recorder(const Shape& shape, RecorderOptions options);

  AskedOfRun asked() const override { return {.within = true, .progress_within = true}; }

  void run_started(const Moment& moment, const RunStart& start) override;
  void before_tick(const Moment& moment, std::uint64_t tick, Nanoseconds time) override;
  void after_tick(const Moment& moment, const TickReport& report) override;
  void run_ended(const Moment& moment, const RunEnd& end) override;

  // Takes a line that a leaf has logged: the recording has it in the line of its tick. May be
  // called from any thread.
  void log(std::string_view who, std::string_view level, std::string_view text);

  // Cheap enough for every tick.
  bool failed() const { return file_.failed(); }
  // "" if there is no error. Set in the constructor if the file cannot be created.
  const std::string& error() const { return file_.error(); }
  // Ticks that are not in the recording because the disk was too slow.
  std::uint64_t lost() const { return lost_; }

 private:
  void add_gap(PacketHead& head) const;
  void plan_whole(std::uint64_t tick);
  void plan_part(const TickReport& report);
  bool wants_part(Nanoseconds time);
  bool push_tick(const Moment& moment, const TickReport& report);
  void write(const std::string& text);
  void tell_error();

  RecorderOptions options_;
  AppendFile file_;
  RunPackets packets_;
  bool may_wait_ = false;  // time stands still, so waiting for the disk delays nothing
  std::uint64_t lost_ = 0;
  std::uint64_t gap_ = 0, gap_from_ = 0;  // the last of these, which no line reports yet
  bool error_told_ = false;
  bool begins_part_ = false;               // with the next line
  std::uint64_t parts_ = 1;                // whose beginnings were accepted
  std::optional<Nanoseconds> part_began_;  // in the time of the run; nothing: before its first tick
  std::uint64_t bytes_since_look_ = 0;
  // The whole state is written again after so many ticks and bytes of packets.
  std::uint64_t next_whole_, bytes_since_whole_ = 0;
  const std::uint64_t bytes_between_wholes_;
};

}  // namespace lockstep::host

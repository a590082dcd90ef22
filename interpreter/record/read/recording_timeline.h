// The ticks of a recording in any order: forward, back, at a number. Used by replays.
//
// A line of a recording contains only changes, so going back means reading from an earlier position
// whose whole state is known: a keyframe. The distance between keyframes is a number of bytes in
// the file, because the cost of reading depends on bytes; a step back takes about a millisecond.
// When keyframes need more than most_memory, every second one is dropped and the distance doubles.
// So the memory is bounded for recordings of any length, and a step back gets slower only for huge
// trees in huge files.
#pragma once

#include <cstdint>
#include <vector>

#include "judge/measure/entry_changes.h"
#include "record/read/recording_reader.h"
#include "record/tick_range.h"

namespace lockstep::host {

// The result of all ticks up to one.
struct Past {
  std::vector<EntryState> entries = {};  // by number; shorter where none of the last has a value
  RecentLines logs = {};
  std::vector<Heard> heard = {};  // of each node that stands for another robot

  void add(const RecordedTick& tick);
  std::size_t memory() const;
  friend bool operator==(const Past&, const Past&) = default;
};

// One tick with the state of all nodes after it.
struct TimelineTick {
  std::uint64_t number = 0;  // of its line among those of ticks, from 0
  std::uint64_t tick = 0;
  double time = 0;  // seconds
  std::vector<RecordedState> nodes;
  std::vector<RecordedFault> faults;
  std::vector<std::string> results = {};    // of each node within the tick; empty: of one moment
  std::vector<RecordedEntry> entries = {};  // that have changed in this tick
  std::vector<LeafLine> logs = {};
  std::uint64_t lost = 0;  // ticks just before it that are not in the recording
  Past past = {};          // with this tick

  friend bool operator==(const TimelineTick&, const TimelineTick&) = default;
};

// Copies the current tick of a reader to `moment`, which is at the tick before.
void take(const RecordedTick& tick, std::uint64_t lost, TimelineTick& moment);

struct TimelineOptions {
  std::uint64_t distance = 64 << 10;  // bytes of the file from one keyframe to the next, at first
  std::uint64_t most_memory = 32 << 20;  // bytes of all keyframes
  TickRange range = {};                  // the ticks that it has
};

class RecordingTimeline {
 public:
  // Reads the recording, or its range, to its end or up to damage, and goes to its first tick. Its
  // file must be seekable. From now on only the timeline may use the reader.
  explicit RecordingTimeline(RecordingReader& reader, const TimelineOptions& options = {});

  const RecordingOutcome& outcome() const { return outcome_; }
  // The number of ticks. If it is 0, none of the following functions may be called.
  std::uint64_t size() const { return size_; }
  std::uint64_t first_tick() const { return keyframes_.front().moment.tick; }
  std::uint64_t last_tick() const { return last_tick_; }
  double last_time() const { return last_time_; }

  const TimelineTick& now() const { return now_; }
  bool at_end() const { return now_.number + 1 == size_; }
  // When the next tick began; not at the end.
  double next_time() const { return next_->time; }

  // They do nothing at the end and at the beginning.
  void step_forward();
  void step_back();
  // The tick with this number, else the last before it, else the first.
  void go_to_tick(std::uint64_t tick);
  void go_to_begin() { go_to_number(0); }
  void go_to_end() { go_to_number(size_ - 1); }

  // The file was changed, so nothing can be read any more.
  bool failed() const { return failed_; }

  std::size_t keyframes() const { return keyframes_.size(); }

 private:
  struct Keyframe {
    TimelineTick moment;
    RecordingReader::Position position;
    std::size_t memory() const;
  };
  void keep(const RecordedTick& tick, std::uint64_t lost, const Past& before);
  void thin_out();
  void restore(const Keyframe& keyframe);
  void go_to_number(std::uint64_t number);
  void read_next();

  RecordingReader& reader_;
  TimelineOptions options_;
  RecordingOutcome outcome_;
  std::vector<Keyframe> keyframes_;  // rising; the first is of the first tick
  std::uint64_t memory_ = 0;         // of them
  std::uint64_t size_ = 0;
  std::uint64_t last_tick_ = 0;
  double last_time_ = 0;
  TimelineTick now_;
  std::optional<RecordedTick> next_;  // the reader is one tick ahead
  bool failed_ = false;
};

}  // namespace lockstep::host

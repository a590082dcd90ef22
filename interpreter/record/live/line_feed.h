// Passes a run to the monitor's server, as lines of a recording: each tick in which something
// happens, and twenty times a second one in which nothing but progress changes. The tick thread
// copies what has changed since the last line into a ring of fixed size; another thread takes it
// out. On a virtual clock a tick waits until there is room. On a real clock it never does: a line
// that does not fit is left out and counted, and the next one has its changes too. A tick allocates
// only for lines that leaves log, for faults, and for entries whose text grows.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/core/deadlines.h"
#include "base/system/bell.h"
#include "record/live/event_counts.h"
#include "record/live/packet_ring.h"
#include "record/live/run_packets.h"
#include "trace/observer.h"

namespace lockstep::host {

class LineFeed final : public Observer {
 public:
  static constexpr std::chrono::milliseconds kPeriod{50};

  using RealTime = Nanoseconds (*)();

  // `real_time` is for tests.
  LineFeed(const Shape& shape, RunDescription run, RealTime real_time = monotonic_now);

  // The next tick gets a line, however soon it comes.
  void hurry() { published_ = Nanoseconds(0); }
  // Passes on a line that a leaf has logged. May be called from any thread.
  void log(std::string_view who, std::string_view level, std::string_view text);

  AskedOfRun asked() const override { return {.within = true}; }
  void run_started(const Moment& moment, const RunStart& start) override;
  void before_tick(const Moment& moment, std::uint64_t tick, Nanoseconds time) override;
  void after_tick(const Moment& moment, const TickReport& report) override;
  void standing(const Moment& moment) override;
  void run_ended(const Moment& moment, const RunEnd& end) override;

  // --- for the thread that takes the lines out ---------------------------------------------------

  // Once run_started, or run_ended, has returned.
  const std::string& header() const { return header_; }
  const std::string& end() const { return end_; }
  // Adds whole lines: those since the last call. One with the whole state also has what the run has
  // had of everything that is counted (record/live/event_counts.h).
  void take(std::string& lines);
  // From here on somebody takes them, who can be woken by the tick thread; and not any more.
  void begin_taking(std::function<void()> wake);
  void end_taking();
  // The longest tick and the largest lateness since the last call; nothing on a virtual clock, and
  // when there was no tick.
  struct Times {
    Nanoseconds took, late;
  };
  std::optional<Times> take_times();
  // The next line is to have the whole state.
  void want_full() { wants_full_.store(true, std::memory_order_relaxed); }

 private:
  void publish(const Moment& moment);
  void publish_before_late(Nanoseconds time);
  bool push(Packet packet);
  bool wait_to_push(const Packet& packet);
  void note_times(Nanoseconds time);

  const RealTime real_time_;
  const Deadlines deadlines_;
  RunPackets packets_;
  PacketRing ring_;
  std::string header_, end_;
  bool is_real_time_ = false;
  Nanoseconds began_{0};                           // the last tick
  std::atomic<std::int64_t> took_{-1}, late_{-1};  // ns, the most since they were taken
  TickReport last_;                                // of the last tick
  std::vector<Fault> faults_;                      // since the last line
  Nanoseconds published_{0};                       // when
  bool is_due_ = false;                            // a line, after this tick
  bool has_ticked_ = false;
  bool is_shown_ = true;                    // the last tick has its line
  std::uint64_t lost_ = 0, lost_from_ = 0;  // ticks whose line found no room, since the last line
  std::atomic<bool> wants_full_{true};
  std::function<void()> wake_;
  std::atomic<bool> has_taker_{false}, is_full_{false};
  Bell room_made_;

  // The taking thread alone uses what follows.
  std::vector<char> room_;
  EventCounts counts_;
};

}  // namespace lockstep::host

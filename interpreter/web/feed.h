// Passes a run to the monitor's server: lines of a recording, at most twenty a second. The tick
// thread copies what has changed since the last line into a ring of fixed size; another thread
// takes it out. A line that does not fit is left out, and the next one has its changes too. A tick
// allocates only for lines that leaves log, for faults, and for entries whose text grows.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "recording/write/packet_ring.h"
#include "recording/write/run_packets.h"
#include "runtime/deadlines.h"
#include "runtime/observer.h"

namespace lockstep {

class MonitorFeed final : public Observer {
 public:
  static constexpr std::chrono::milliseconds kPeriod{50};

  using RealTime = Nanoseconds (*)();

  // `real_time` is for tests.
  MonitorFeed(const Tree& tree, RunDescription run, RealTime real_time = monotonic_now);

  // The next tick gets a line, however soon it comes.
  void hurry() { published_ = Nanoseconds(0); }
  // What a leaf logs; from any thread.
  void log(std::string_view who, std::string_view level, std::string_view text);

  void run_started(Ticker& ticker, const RunStart& start) override;
  void before_tick(Ticker& ticker, std::uint64_t tick, Nanoseconds time) override;
  void after_tick(Ticker& ticker, const TickReport& report) override;
  void standing(Ticker& ticker) override;
  void run_ended(Ticker& ticker, const RunEnd& end) override;

  // --- for the thread that takes the lines out ---------------------------------------------------

  // Once run_started, or run_ended, has returned.
  const std::string& header() const { return header_; }
  const std::string& end() const { return end_; }
  // Whole lines: those since the last call.
  void take(std::string& lines);
  // The longest tick and the largest lateness since the last call; nothing on a virtual clock, and
  // when there was no tick.
  struct Times {
    Nanoseconds took, late;
  };
  std::optional<Times> take_times();
  // The next line is to have the whole state.
  void want_full() { wants_full_.store(true, std::memory_order_relaxed); }

 private:
  void publish(Ticker& ticker);
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
  bool is_shown_ = true;  // the last tick has its line
  std::atomic<bool> wants_full_{true};
  std::vector<char> room_;  // of the taking thread
};

}  // namespace lockstep

// Watches the run of a program as the command's runs are watched: a recording, browsers, Groot2.
// Only within embedding/.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/problem.h"
#include "base/system/mutex.h"
#include "engine/tree.h"
#include "record/live/run_packets.h"
#include "record/write/recorder.h"
#include "run/observers.h"
#include "show/web/monitor.h"

namespace lockstep::host::embedding {

class RunWatchers {
 public:
  RunWatchers(const Tree& tree, RunDescription run, RunStart start);

  // The run goes on after a cut, which is logged. Before who logs is there.
  // `set`: as in RunStart.
  void go_on(std::uint64_t first_tick, Nanoseconds gap, std::span<const std::uint32_t> set,
             std::string text);
  // Both are called before the first tick, and return what is wrong, or nothing. `on_error` is
  // called once, when the recording cannot be written any more.
  std::optional<Problem> record(std::string file,
                                std::function<void(const std::string& error)> on_error);
  // The link.
  Result<std::string> monitor(const std::string& address);
  // Also after it; null: not any more.
  void show_groot(std::unique_ptr<Observer> groot, Ticker& ticker);
  bool log_somewhere() const { return recorder_ || monitor_; }
  bool has_groot() const { return groot_ != nullptr; }

  // Before the first tick. It must live until the end.
  void watch(Observer& observer) { observers_.push_back(&observer); }

  // Passes on a line that a leaf has logged. May be called from any thread.
  void log(std::string_view who, std::string_view level, std::string_view text);

  bool empty() const { return observers_.empty(); }
  std::span<Observer* const> observers() const { return observers_; }
  // Around the ticks of a program that ticks itself. The loop calls its observers.
  void before_tick(Ticker& ticker, Nanoseconds time);
  void after_tick(Ticker& ticker, const TickReport& report);
  // The leaves were halted between two ticks, at `time`. Groot2 sees it at once, all others with
  // the next tick.
  void halted(Ticker& ticker, Nanoseconds time);
  // A loop has called them to the end of the run.
  void end_with_loop() { is_begun_ = false; }
  // The end of the run, after its last halt. Nobody watches any more.
  void end(Ticker& ticker, Nanoseconds last);

 private:
  const Tree& tree_;
  const RunDescription run_;
  RunStart start_;
  std::vector<std::uint32_t> set_;  // of it
  std::string resumed_;             // "": it has begun
  bool is_begun_ = false;
  Status status_ = Status::Idle;  // of the root, after the last tick
  std::vector<Observer*> observers_;
  std::optional<Observers> all_;  // from the first tick on
  std::unique_ptr<Observer> groot_;
  Mutex mutex_;  // of these two, for threads that log
  std::optional<Recorder> recorder_;
  std::optional<Monitor> monitor_;
};

}  // namespace lockstep::host::embedding

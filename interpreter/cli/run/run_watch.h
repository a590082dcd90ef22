// Watches the plugins of `lockstep run` and reports problems: slow leaves, halts that do not
// return, changed modes, growing memory.
#pragma once

#include <signal.h>

#include <functional>
#include <optional>
#include <string>

#include "cli/run/run_options.h"
#include "engine/leaf_watch.h"
#include "judge/summary/summary.h"
#include "run/watchdog.h"
#include "trace/observer.h"

namespace lockstep::host {

class RunWatch final : public Observer {
 public:
  // The shape must outlive this. `print` shows a line to the person; from any thread.
  RunWatch(const Shape& shape, const RunCommandOptions& options,
           std::function<void(const std::string& line)> print);

  LeafWatch& leaves() { return leaves_; }
  // Must be the last of the observers, because the initial memory of the others is not a leak.
  void run_started(const Moment& moment, const RunStart& start) override;
  void after_tick(const Moment& moment, const TickReport& report) override;
  void run_ended(const Moment& moment, const RunEnd& end) override;
  void add_to(Summary& summary) const;

 private:
  LeafWatchOptions leaf_watch_options();
  WatchdogOptions watchdog_options();

  const Shape& shape_;
  const RunCommandOptions& options_;
  std::function<void(const std::string& line)> print_;
  std::optional<TickAlarm> alarm_;  // none: each call is timed, or none is
  LeafWatch leaves_;
  Watchdog watchdog_;
  sigset_t signal_mask_;                        // of the tick thread, as it was
  std::size_t memory_at_start_ = 0;             // bytes
  bool has_carried_ = false;                    // much, between processes
  std::size_t out_of_range_ = 0, went_on_ = 0;  // leaves that were reported
  std::vector<std::string> notes_;              // for the summary
};

}  // namespace lockstep::host

// The view that the user sees during a run: live, plain lines or nothing.
#pragma once

#include <optional>
#include <string>

#include "base/system/mutex.h"
#include "leaves/plugin/contract/leaf_set.h"
#include "show/view/console_live.h"
#include "show/view/console_plain.h"
#include "show/view/line_budget.h"

namespace lockstep::host {

class View {
 public:
  // Logs of leaves have the same limit as plain lines, in any view: a burst of lines, then one a
  // second.
  static constexpr std::int64_t kBurst = ConsolePlain::kBurst;

  // `mode` is auto, live, plain or none. Logs of leaves below the level `least` are not shown.
  View(const std::string& mode, const Shape& shape, lockstep_log_level least);

  // Null when there is nothing to show.
  Observer* observer();
  // Before the run starts: it continues after a cut, with this tick.
  void continue_with(std::uint64_t tick, Nanoseconds time);
  // A line for the person, whatever the view. Any thread.
  void print(const std::string& line);
  // Prints what leaves log.
  LeafLog leaf_log();
  // The last frame stays; from now on stderr can be written directly.
  void close();

  // Leaves the terminal usable. Async-signal-safe.
  static void last_words();

 private:
  void log(const std::string& line);
  void print_left_out(std::uint64_t lines);

  const lockstep_log_level least_;
  Mutex mutex_;  // leaves log from any thread
  LineBudget budget_ LOCKSTEP_GUARDED_BY(mutex_){kBurst};
  std::optional<ConsoleLive> live_;
  std::optional<ConsolePlain> plain_;
};

}  // namespace lockstep::host

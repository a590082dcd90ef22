// Writes a run to a file as JSON Lines, one line per tick with what changed: docs/recording.md. On
// a virtual clock the same run gives the same bytes. Allocates nothing per tick once warm.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "observers/append_file.h"
#include "observers/recording.h"
#include "runtime/observer.h"

namespace lockstep {

struct RecorderOptions {
  std::string path;       // of the recording
  std::string tree_file;  // as the user named it
  double rate_hz = 0;
  std::uint64_t seed = 0;
  std::map<std::string, std::string, std::less<>> arguments = {};
  // Called once, on the tick thread, when the recording cannot be written. The run goes on.
  std::function<void(const std::string& error)> on_error = {};
};

class Recorder final : public Observer {
 public:
  Recorder(const Tree& tree, RecorderOptions options);

  void run_started(Ticker& ticker, const RunStart& start) override;
  void before_tick(Ticker& ticker, std::uint64_t tick, Nanoseconds time) override;
  void after_tick(Ticker& ticker, const TickReport& report) override;
  void run_ended(Ticker& ticker, const RunEnd& end) override;

  // "" while all is well. Known from construction on when the file cannot be created.
  const std::string& error() const { return file_.error(); }

 private:
  void take_snapshots(Ticker& ticker);
  void write_changes(Ticker& ticker);
  void end_line();
  void flush();
  void tell_error();

  const Tree& tree_;
  RecorderOptions options_;
  AppendFile file_;
  std::vector<NodeIndex> synchronized_nodes_;
  std::vector<double> progress_;     // at the start of this tick
  std::vector<RecordedState> last_;  // as in the line before
  bool error_told_ = false;
};

}  // namespace lockstep

// The live view of a run on a terminal. A separate thread takes snapshots of the run and draws
// them, and reads the keys that browse them; the tick thread never waits for it while the run goes
// on.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/terminal/keys.h"
#include "base/terminal/raw_terminal.h"
#include "base/terminal/screen.h"
#include "base/terminal/terminal.h"
#include "record/live/snapshot_feed.h"
#include "record/live/watcher_thread.h"
#include "show/view/tree_browser.h"
#include "show/view/tree_view.h"

namespace lockstep::host {

struct LiveOptions {
  int keys = -1;  // file descriptor of a terminal, or none
  bool color = true;
  bool unicode = true;
};

class ConsoleLive final : public Observer {
 public:
  static constexpr std::size_t kMostLines = 1000;

  ConsoleLive(Shape shape, const LiveOptions& options, Outlet& out = messages());
  // Leaves the last frame on the screen and the cursor visible below it.
  ~ConsoleLive() override;
  ConsoleLive(const ConsoleLive&) = delete;
  ConsoleLive& operator=(const ConsoleLive&) = delete;

  void run_started(const Moment& moment, const RunStart& start) override;
  void after_tick(const Moment& moment, const TickReport& report) override;
  void standing(const Moment& moment) override;
  void run_ended(const Moment& moment, const RunEnd& end) override;

  // A line that scrolls by above the view. May be called from any thread; the line appears with the
  // next frame, or at once after the last one. If a frame has more than kMostLines, the rest is
  // counted.
  void print(std::string line);

 private:
  void stop();
  void draw_until_stopped();
  void draw_frame();
  bool wait();  // false: it is time to stop
  void read_keys();
  void press(std::optional<Key> key);
  std::string take_printed();
  DrawOptions draw_options() const;

  const Shape shape_;
  LiveOptions options_;
  Outlet& out_;
  SnapshotFeed feed_;
  std::optional<RawTerminal> terminal_;  // while the thread draws

  // The drawing thread's.
  Screen screen_;
  TerminalSize size_;
  bool is_away_ = false;
  std::string above_;  // lines that the next frame takes with it
  bool is_due_ =
      false;  // a frame: after a key, for the terminal, or because it did not accept the last one
  KeyDecoder decoder_;
  TreeBrowser browser_{shape_};

  std::mutex mutex_;  // for what follows
  std::vector<std::string> printed_;
  std::size_t left_out_ = 0;
  bool stopped_ = false;
  WatcherThread thread_;
};

}  // namespace lockstep::host

#include "cli/tools/replay_session.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "base/core/clock.h"
#include "base/terminal/raw_terminal.h"
#include "base/terminal/screen.h"
#include "base/terminal/terminal.h"
#include "base/terminal/terminal_wait.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "run/crash_report.h"
#include "run/stop_signals.h"
#include "show/view/replay/replay_view.h"
#include "show/view/tree_browser.h"

namespace lockstep::host {
namespace {

constexpr double kFrame = 0.03;  // seconds; an eye needs no more
// A signal may arrive just before we wait.
constexpr std::chrono::duration<double> kPatience{0.2};
constexpr std::chrono::milliseconds kLastFrame{300};  // for the terminal to take it

class ReplaySession {
 public:
  ReplaySession(const RecordingHeader& header, RecordingTimeline& timeline, double speed)
      : header_(header), player_(timeline, speed) {}

  int play() {
    while (!player_.has_quit() && !player_.timeline().failed() && StopSignals::received() == 0) {
      if (!has_terminal()) continue;
      show();
      const TerminalEvent event = wait();
      pass_time();
      if (event == TerminalEvent::Resize) redraw();
      if (event == TerminalEvent::None) press(decoder_.idle());
      if (event == TerminalEvent::Key && !read_keys()) break;
    }
    out_.flush(kLastFrame);
    show();
    return StopSignals::received() == 0 ? kExitSuccess : kExitSignal + StopSignals::received();
  }

 private:
  // After a stop the replay goes on where it was. In the background it waits.
  bool has_terminal() {
    const RawTerminal::State state = terminal_.take();
    if (state == RawTerminal::State::Kept) return true;
    screen_.leave();
    shown_.clear();
    if (state == RawTerminal::State::Away) std::this_thread::sleep_for(kPatience);
    last_ = monotonic_now();
    return state == RawTerminal::State::Taken;
  }

  void show() {
    const RecordingTimeline& timeline = player_.timeline();
    const auto& end = timeline.outcome().end;
    const bool ended = timeline.at_end() && end;
    snapshot_ = snapshot_of(header_, timeline.now(), ended ? &*end : nullptr);
    std::string frame = draw_replay(header_, snapshot_, player_, options());
    if (frame != shown_ && screen_.show("", frame)) shown_ = std::move(frame);
  }

  DrawOptions options() const {
    const TerminalSize size = terminal_size(results_file());
    return {.width = size.width,
            .height = size.height,
            .color = wants_color(results_file()),
            .unicode = has_unicode(),
            .keys = true,
            .browsing = &browser_.browsing()};
  }

  // Until a key, another size of the window, or the next frame.
  TerminalEvent wait() const {
    const double longest = kPatience.count();
    return wait_.wait(std::min(longest, std::max(kFrame, player_.wait().value_or(longest))));
  }

  // From the top: it is unknown how the terminal has wrapped the old lines.
  void redraw() {
    screen_.clear();
    shown_.clear();
  }

  void pass_time() {
    const Nanoseconds now = monotonic_now();
    player_.pass(to_seconds(now - std::exchange(last_, now)));
  }

  // False when the terminal is gone.
  bool read_keys() {
    const auto keys = RawTerminal::read_keys();
    for (const char byte : keys.value_or("")) press(decoder_.take(byte));
    return keys.has_value();
  }

  // While the number of a tick is typed, all keys belong to it.
  void press(std::optional<Key> key) {
    if (!key) return;
    const bool is_browsing =
        !player_.typed() && browser_.press(*key, snapshot_, rows_for_nodes(options()));
    if (!is_browsing) player_.press(*key);
  }

  const RecordingHeader& header_;
  ReplayPlayer player_;
  TreeBrowser browser_{header_};
  Snapshot snapshot_;  // that is shown
  RawTerminal terminal_{STDIN_FILENO, results_file()};
  TerminalWait wait_{STDIN_FILENO};
  Outlet out_{results_file()};
  Outlet::Thread out_thread_{out_};
  Screen screen_{out_};
  KeyDecoder decoder_;
  std::string shown_;
  Nanoseconds last_ = monotonic_now();
};

}  // namespace

int play_on_terminal(const RecordingHeader& header, RecordingTimeline& timeline, double speed) {
  StopSignals::install(&RawTerminal::restore_for_good);
  CrashReport::set_last_words(&RawTerminal::restore_for_good);
  const int code = ReplaySession(header, timeline, speed).play();
  if (!timeline.failed()) return code;
  print_error("the recording was changed while it was read");
  return kExitInvalidTree;
}

}  // namespace lockstep::host

// The live view of a run on a terminal. A thread of its own draws, ten times a second at most; the
// tick thread only copies the state of the nodes, as often, into a buffer that nobody locks.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "observers/screen.h"
#include "observers/tree_view.h"
#include "observers/triple_buffer.h"
#include "runtime/observer.h"

namespace lockstep {

struct LiveOptions {
  bool color = true;
  bool unicode = true;
};

class ConsoleLive final : public Observer {
 public:
  static constexpr std::chrono::milliseconds kFrame{100};
  static constexpr std::size_t kMostLines = 1000;

  ConsoleLive(const Tree& tree, const LiveOptions& options, Outlet& out = messages());
  // Leaves the last frame on the screen and the cursor visible below it.
  ~ConsoleLive() override;
  ConsoleLive(const ConsoleLive&) = delete;
  ConsoleLive& operator=(const ConsoleLive&) = delete;

  void run_started(Ticker& ticker, const RunStart& start) override;
  void after_tick(Ticker& ticker, const TickReport& report) override;
  void run_ended(Ticker& ticker, const RunEnd& end) override;

  // A line that scrolls by above the view. From any thread; shown with the next frame, or at once
  // after the last one. Of more than kMostLines for a frame, the rest is counted.
  void print(std::string line);

 private:
  void publish(Ticker& ticker);
  void take_progress(Ticker& ticker, NodeIndex node, std::vector<NodeView>& views);
  void stop();
  void draw_until_stopped();
  void draw_frame();
  std::string take_printed();

  const Tree& tree_;
  const TreeShape shape_;
  LiveOptions options_;
  Outlet& out_;
  std::vector<NodeIndex> synchronized_nodes_;

  // The tick thread's.
  Snapshot::Header header_;
  std::vector<Activity> activity_;  // after the last tick
  std::chrono::steady_clock::time_point published_{};
  TripleBuffer<Snapshot> snapshots_;

  // The drawing thread's.
  Screen screen_;
  std::string above_;     // lines that the next frame takes with it
  bool is_drawn_ = true;  // false: the terminal did not take the last frame

  std::mutex mutex_;  // for what follows
  std::condition_variable wake_;
  std::vector<std::string> printed_;
  std::size_t left_out_ = 0;
  bool stopped_ = false;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace lockstep

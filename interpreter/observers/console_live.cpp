#include "observers/console_live.h"

#include <fmt/format.h>

#include <new>
#include <utility>

#include "core/diagnostics.h"
#include "core/own_thread.h"
#include "engine/synchronized.h"
#include "measure/synchronized_measure.h"
#include "observers/statistics.h"
#include "observers/terminal.h"

namespace lockstep {

ConsoleLive::ConsoleLive(const Tree& tree, const LiveOptions& options, Outlet& out)
    : tree_(tree),
      shape_(shape_of(tree)),
      options_(options),
      out_(out),
      synchronized_nodes_(synchronized_nodes(tree)),
      activity_(tree.nodes.size()),
      snapshots_(Snapshot{.header = {}, .nodes = std::vector<NodeView>(tree.nodes.size())}),
      screen_(out) {}

ConsoleLive::~ConsoleLive() {
  try {
    stop();
  } catch (const std::bad_alloc&) {  // lines that nobody will see; the thread has ended
  }
}

void ConsoleLive::run_started(Ticker&, const RunStart& start) {
  header_.rate_hz = 1.0 / to_seconds(start.period);
  header_.real_time = start.real_time;
  thread_ = own_thread([this] { draw_until_stopped(); });
}

void ConsoleLive::after_tick(Ticker& ticker, const TickReport& report) {
  header_.tick = report.tick;
  header_.time = report.time;
  *header_.overruns += report.skipped > 0;
  for (const Fault& fault : report.faults) print(fault_text(tree_, fault, report.tick));
  activity_ = ticker.run_state().activity;
  const auto now = std::chrono::steady_clock::now();
  if (now - published_ < kFrame) return;
  published_ = now;
  publish(ticker);
}

// By now everything has been halted; what stays on the screen is where the last tick left it.
void ConsoleLive::run_ended(Ticker& ticker, const RunEnd& end) {
  header_.result = end.result();
  publish(ticker);
  stop();
}

void ConsoleLive::publish(Ticker& ticker) {
  Snapshot& back = snapshots_.back();
  back.header = header_;
  for (NodeIndex node = 0; node < back.nodes.size(); ++node) {
    back.nodes[node] = {.activity = activity_[node]};
  }
  for (const NodeIndex node : synchronized_nodes_) take_progress(ticker, node, back.nodes);
  snapshots_.publish();
}

void ConsoleLive::take_progress(Ticker& ticker, NodeIndex node, std::vector<NodeView>& views) {
  NodeIndex child = node + 1;
  for (const double used : child_progress(ticker, node)) {
    views[child].progress = shown_progress(views[child].activity, used);
    child = ticker.end_of(child);
  }
}

void ConsoleLive::print(std::string line) {
  const std::lock_guard lock(mutex_);
  if (stopped_) {
    out_.say(printable(line) + "\n");
  } else if (printed_.size() < kMostLines) {
    printed_.push_back(std::move(line));
  } else {
    ++left_out_;
  }
}

void ConsoleLive::stop() {
  if (thread_.joinable()) {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  out_.say(take_printed());
}

void ConsoleLive::draw_until_stopped() {
  screen_.begin();
  bool stopped = false;
  while (!stopped) {
    draw_frame();
    std::unique_lock lock(mutex_);
    stopped = wake_.wait_for(lock, kFrame, [this] { return stopping_; });
  }
  out_.flush(3 * kFrame);  // for the last frame there is no later one
  draw_frame();
  screen_.end();
}

void ConsoleLive::draw_frame() {
  if (is_drawn_) above_ = take_printed();
  if (!snapshots_.take() && above_.empty() && is_drawn_) return;
  const TerminalSize size = terminal_size(out_.file());
  const std::string frame = draw(shape_, snapshots_.front(),
                                 {.width = size.width,
                                  .height = size.height,
                                  .color = options_.color,
                                  .unicode = options_.unicode});
  is_drawn_ = screen_.show(above_, frame);
}

std::string ConsoleLive::take_printed() {
  const std::lock_guard lock(mutex_);
  std::string text;
  for (const std::string& line : printed_) text += printable(line) + "\n";
  if (left_out_ > 0) text += fmt::format("... {} lines left out\n", left_out_);
  printed_.clear();
  left_out_ = 0;
  return text;
}

}  // namespace lockstep

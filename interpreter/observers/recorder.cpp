#include "observers/recorder.h"

#include <iterator>
#include <utility>

#include "measure/synchronized_measure.h"
#include "observers/statistics.h"

namespace lockstep {
namespace {

// Nanoseconds as exact seconds, "0.03", where a double would say 0.030000000000000002.
void append_seconds(fmt::memory_buffer& out, Nanoseconds time) {
  const auto total = static_cast<std::uint64_t>(time.count());
  fmt::format_to(std::back_inserter(out), "{}.{:09}", total / 1'000'000'000, total % 1'000'000'000);
  std::size_t size = out.size();
  while (out[size - 1] == '0' && out[size - 2] != '.') --size;
  out.resize(size);
}

void append(fmt::memory_buffer& out, std::string_view text) {
  out.append(text.data(), text.data() + text.size());
}

}  // namespace

Recorder::Recorder(const Tree& tree, RecorderOptions options)
    : tree_(tree),
      options_(std::move(options)),
      file_(options_.path),
      synchronized_nodes_(synchronized_nodes(tree)),
      progress_(tree.nodes.size()),
      last_(tree.nodes.size()) {}

void Recorder::run_started(Ticker&, const RunStart& start) {
  append(file_.buffer(), to_json(RecordingHeader{.tree = tree_.id,
                                                 .file = options_.tree_file,
                                                 .version = LOCKSTEP_VERSION,
                                                 .rate_hz = options_.rate_hz,
                                                 .clock = start.real_time ? "wall" : "virtual",
                                                 .seed = options_.seed,
                                                 .arguments = options_.arguments,
                                                 .nodes = describe(tree_)}));
  end_line();
  flush();
}

void Recorder::before_tick(Ticker& ticker, std::uint64_t, Nanoseconds) {
  for (NodeIndex node = 0; node < progress_.size(); ++node) {
    progress_[node] = ticker.status(node) == Status::Idle ? 0.0 : ticker.progress(node);
  }
}

void Recorder::after_tick(Ticker& ticker, const TickReport& report) {
  take_snapshots(ticker);
  fmt::memory_buffer& out = file_.buffer();
  fmt::format_to(std::back_inserter(out), "{{\"tick\":{},\"time_s\":", report.tick);
  append_seconds(out, report.time);
  append(out, ",\"nodes\":[");
  write_changes(ticker);
  append(out, "]}");
  end_line();
}

// What a synchronized node has seen counts more than what was seen before its tick.
void Recorder::take_snapshots(Ticker& ticker) {
  for (const NodeIndex node : synchronized_nodes_) {
    if (!ticker.ticked(node)) continue;
    NodeIndex child = node + 1;
    for (const double progress : child_progress(ticker, node)) {
      progress_[child] = progress;
      child = ticker.end_of(child);
    }
  }
}

void Recorder::write_changes(Ticker& ticker) {
  const char* separator = "";
  for (NodeIndex node = 0; node < last_.size(); ++node) {
    const RecordedState now{.status = ticker.status(node),
                            .progress = progress_[node],
                            .ticked = ticker.ticked(node),
                            .held = ticker.held(node)};
    if (now == last_[node]) continue;
    last_[node] = now;
    fmt::format_to(std::back_inserter(file_.buffer()), "{}[{},\"{}\",{},{:d},{:d}]", separator,
                   node, to_string(now.status), now.progress, now.ticked, now.held);
    separator = ",";
  }
}

void Recorder::run_ended(Ticker& ticker, const RunEnd& end) {
  RecordedEnd closing{.result = std::string(result_text(end.status)),
                      .reason = std::string(to_string(end.reason)),
                      .fault = fault_text(ticker),
                      .signal = {},
                      .ticks = end.ticks,
                      .time = to_seconds(end.time),
                      .overruns = end.overruns,
                      .skipped = end.skipped};
  if (end.reason == StopReason::Signal) closing.signal = end.signal;
  append(file_.buffer(), to_json(closing));
  end_line();
  flush();
}

void Recorder::end_line() {
  file_.buffer().push_back('\n');
  file_.line_done();
  tell_error();
}

void Recorder::flush() {
  file_.flush();
  tell_error();
}

void Recorder::tell_error() {
  if (error_told_ || error().empty()) return;
  error_told_ = true;
  if (options_.on_error) options_.on_error(error());
}

}  // namespace lockstep

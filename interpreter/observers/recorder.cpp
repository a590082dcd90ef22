#include "observers/recorder.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "observers/recording_text.h"
#include "observers/statistics.h"

namespace lockstep {
namespace {

// The longest line of a tick without faults, and the line before it that tells of lost ticks.
std::size_t most_of_line(const Tree& tree) {
  constexpr std::size_t kMostOfRest = 256;
  return kMostOfRest + tree.nodes.size() * kMostOfNode;
}

// A line that is longer than the queue could never be written, so the queue has room for several.
// (Only the messages of faults have no limit. A line that is too long because of them is lost, the
// one after it is not.)
std::size_t queue_of(const Tree& tree, std::size_t wanted) {
  constexpr std::size_t kLines = 4;
  return std::max(wanted, kLines * most_of_line(tree));
}

}  // namespace

Recorder::Recorder(const Tree& tree, RecorderOptions options)
    : tree_(tree),
      options_(std::move(options)),
      file_(options_.path, queue_of(tree, options_.queue)),
      delta_(tree) {
  line_.reserve(most_of_line(tree));
}

void Recorder::run_started(Ticker&, const RunStart& start) {
  may_wait_ = !start.real_time;
  write(to_json(RecordingHeader{.tree = tree_.id,
                                .file = options_.tree_file,
                                .version = LOCKSTEP_VERSION,
                                .rate_hz = options_.rate_hz,
                                .clock = start.real_time ? "wall" : "virtual",
                                .seed = options_.seed,
                                .arguments = options_.arguments,
                                .nodes = describe(tree_)}));
}

// Also when the file has failed: what leaves are asked must not depend on a disk.
void Recorder::before_tick(Ticker& ticker, std::uint64_t, Nanoseconds) {
  delta_.before_tick(ticker);
}

void Recorder::after_tick(Ticker& ticker, const TickReport& report) {
  if (!failed()) {
    write_line(ticker, report);
    if (push()) {
      delta_.keep();
      gap_ = 0;
    } else if (!failed()) {
      if (gap_ == 0) gap_from_ = report.tick;
      ++gap_;
      ++lost_;
    }
  }
  tell_error();
}

// A gap is told together with the line after it: either both are in the file or none.
void Recorder::write_line(Ticker& ticker, const TickReport& report) {
  line_.clear();
  if (gap_ > 0) append_lost(line_, gap_, gap_from_);
  fmt::format_to(std::back_inserter(line_), "{{\"tick\":{},\"time_s\":", report.tick);
  append_seconds(line_, report.time);
  append_text(line_, ",\"nodes\":[");
  delta_.append(ticker, line_);
  line_.push_back(']');
  if (!report.faults.empty()) {
    append_text(line_, ",\"faults\":");
    append_faults(line_, report.faults);
  }
  append_text(line_, "}\n");
}

bool Recorder::push() {
  const std::string_view line(line_.data(), line_.size());
  if (file_.push(line)) return true;
  if (!may_wait_) return false;
  file_.flush();
  return file_.push(line);
}

void Recorder::run_ended(Ticker& ticker, const RunEnd& end) {
  RecordedEnd closing{.result = std::string(result_text(end.status)),
                      .reason = std::string(to_string(end.reason)),
                      .fault = fault_text(ticker),
                      .signal = {},
                      .ticks = end.ticks,
                      .time = to_seconds(end.time),
                      .overruns = end.overruns,
                      .skipped = end.skipped,
                      .lost = lost_};
  if (end.reason == StopReason::Signal) closing.signal = end.signal;
  write(to_json(closing));
}

// The first and the last line are not lost, even if the run has to wait for them.
void Recorder::write(const std::string& line) {
  line_.clear();
  if (gap_ > 0) append_lost(line_, gap_, gap_from_);
  append_text(line_, line);
  line_.push_back('\n');
  file_.write({line_.data(), line_.size()});
  tell_error();
}

void Recorder::tell_error() {
  if (error_told_ || !failed()) return;
  error_told_ = true;
  if (options_.on_error) options_.on_error(error());
}

}  // namespace lockstep

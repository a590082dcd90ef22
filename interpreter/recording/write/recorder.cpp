#include "recording/write/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/parameter_value.h"
#include "core/wording.h"
#include "measure/synchronized_measure.h"
#include "summary/statistics.h"

namespace lockstep {
namespace {

// A packet that is longer than the queue could never be written, so the queue has room for several.
// (Only the messages of faults have no limit. A tick that is too long because of them is lost, the
// one after it is not.)
std::size_t queue_of(const Tree& tree, std::size_t wanted) {
  constexpr std::size_t kTicks = 4;
  const std::size_t longest = packet_size(tree.nodes.size(), kPacketCell);
  return std::max(wanted, kTicks * longest);
}

std::vector<std::uint32_t> slots_of(const Tree& tree,
                                    const std::optional<std::vector<std::string>>& keys) {
  std::vector<std::uint32_t> slots;
  for (std::uint32_t slot = 0; slot < tree.slots.size(); ++slot) {
    const bool wanted = !keys || std::ranges::find(*keys, tree.slots[slot].name) != keys->end();
    if (wanted) slots.push_back(slot);
  }
  return slots;
}

}  // namespace

Recorder::Recorder(const Tree& tree, RecorderOptions options)
    : tree_(tree),
      options_(std::move(options)),
      file_(options_.path, queue_of(tree, options_.queue), options_.format),
      delta_(tree),
      slots_(slots_of(tree, options_.entries)),
      entries_(slots_) {
  const auto repeating = std::ranges::count_if(
      tree.nodes, [](const Node& node) { return node.kind->round != nullptr; });
  line_end_.reserve(options_.format.most_of_tick_end(
      synchronized_nodes(tree).size() + tree.members.size() + static_cast<std::size_t>(repeating),
      slots_.size()));
}

void Recorder::run_started(Ticker&, const RunStart& start) {
  may_wait_ = !start.real_time;
  write(options_.format.header({.tree = tree_.id,
                                .file = options_.tree_file,
                                .version = LOCKSTEP_VERSION,
                                .rate_hz = options_.rate_hz,
                                .clock = start.real_time ? "wall" : "virtual",
                                .seed = options_.seed,
                                .arguments = options_.arguments,
                                .nodes = describe(tree_),
                                .entries = keys()}));
}

std::vector<RecordedKey> Recorder::keys() const {
  std::vector<RecordedKey> keys;
  for (const std::uint32_t slot : slots_) {
    const auto& entry = tree_.slots[slot];
    keys.push_back({entry.name, std::string(type_name(entry.type, entry.object))});
  }
  return keys;
}

void Recorder::log(std::string_view who, std::string_view level, std::string_view text) {
  lines_.add(who, level, text);
}

// Also after a failure of the file: the calls of leaves must not depend on a disk.
void Recorder::before_tick(Ticker& ticker, std::uint64_t, Nanoseconds) {
  delta_.before_tick(ticker);
}

void Recorder::after_tick(Ticker& ticker, const TickReport& report) {
  if (!failed()) {
    if (push_tick(ticker, report)) {
      delta_.keep();
      entries_.keep();
      lines_.keep();
      gap_ = 0;
    } else if (!failed()) {
      if (gap_ == 0) gap_from_ = report.tick;
      ++gap_;
      ++lost_;
    }
  }
  tell_error();
}

// A gap is written together with the next line: either both are in the file or neither.
PacketHead Recorder::head() const {
  return {.lost = gap_, .lost_from = gap_from_};
}

bool Recorder::push_tick(Ticker& ticker, const TickReport& report) {
  options_.format.set_tick_end(line_end_, {.limits = delta_.limits(ticker),
                                           .rounds = delta_.rounds(ticker),
                                           .succeeded = delta_.succeeded(ticker),
                                           .faults = report.faults,
                                           .entries = entries_.changes(ticker.blackboard()),
                                           .logs = lines_.lines()});
  Packet packet{.head = head(), .nodes = delta_.changes(ticker), .text = line_end_};
  packet.head.is_tick = 1;
  packet.head.tick = report.tick;
  packet.head.time = report.time.count();
  if (file_.push(packet)) return true;
  if (!may_wait_) return false;
  file_.flush();
  return file_.push(packet);
}

void Recorder::run_ended(Ticker& ticker, const RunEnd& end) {
  RecordedEnd closing{.result = std::string(to_string(end.result())),
                      .reason = std::string(to_string(end.reason)),
                      .fault = end.fault ? fault_text(tree_, *end.fault) : "",
                      .signal = {},
                      .ticks = end.ticks,
                      .time = to_seconds(end.time),
                      .overruns = end.overruns,
                      .skipped = end.skipped,
                      .lost = lost_,
                      .notes = {},
                      .logs = {}};
  for (const Fault& fault : ticker.tolerated()) {
    closing.notes.push_back(fault_text(tree_, fault, end.ticks));
  }
  std::ranges::move(out_of_range_notes(ticker), std::back_inserter(closing.notes));
  if (end.reason == StopReason::Signal) closing.signal = end.signal;
  const auto lines = lines_.lines();
  closing.logs.assign(lines.begin(), lines.end());
  if (lines_.left_out() > 0) {
    closing.notes.push_back(
        fmt::format("{} that leaves logged are not recorded", counted(lines_.left_out(), "line")));
  }
  write(options_.format.end(closing));
}

// The first and the last line are not lost, even if the run has to wait for them.
void Recorder::write(const std::string& text) {
  file_.write({.head = head(), .text = text});
  tell_error();
}

void Recorder::tell_error() {
  if (error_told_ || !failed()) return;
  error_told_ = true;
  if (options_.on_error) options_.on_error(error());
}

}  // namespace lockstep

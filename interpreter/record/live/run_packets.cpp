#include "record/live/run_packets.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/core/language.h"
#include "base/core/version.h"
#include "base/core/wording.h"
#include "judge/summary/statistics.h"
#include "record/json_lines.h"

namespace lockstep::host {
namespace {

std::vector<std::uint32_t> slots_of(const Shape& shape,
                                    const std::optional<std::vector<std::string>>& keys) {
  std::vector<std::uint32_t> slots;
  for (std::uint32_t slot = 0; slot < shape.entries.size(); ++slot) {
    const bool wanted = !keys || std::ranges::find(*keys, shape.entries[slot].key) != keys->end();
    if (wanted) slots.push_back(slot);
  }
  return slots;
}

}  // namespace

RunPackets::RunPackets(Shape shape, RunDescription run)
    : shape_(std::move(shape)),
      run_(std::move(run)),
      delta_(shape_),
      slots_(slots_of(shape_, run_.entries)),
      entries_(slots_) {
  constexpr std::size_t kTimesInLine = 3;  // an entry: in `entries`, `given` and `whole`
  std::size_t more = delta_.most_succeeded() + repeating_nodes(shape_).size();
  for (NodeIndex index = 0; index < shape_.nodes.size(); ++index) {
    const ShapeNode& node = shape_.nodes[index];
    if (is_robot(shape_, index)) ++more;
    more += node.members.size() + (node.paces ? node.held().size() : 0);
  }
  line_end_.reserve(
      json_lines::most_of_tick_end(shape_.nodes.size(), more, kTimesInLine * slots_.size()));
}

std::string RunPackets::header(const RunStart& start) const {
  RecordingHeader header;
  static_cast<Shape&>(header) = shape_;
  header.entries = entries_shown();
  header.file = run_.tree_file;
  header.version = kVersion;
  header.law = kLawVersion;
  header.rate_hz = run_.rate_hz;
  header.clock = start.real_time ? "wall" : "virtual";
  header.seed = run_.seed;
  header.arguments = run_.arguments;
  header.values = start_values();
  header.verify = run_.verify;
  header.first_tick = start.first_tick;
  if (start.first_tick > 0) header.resumed_after = to_seconds(start.gap);
  if (run_.exactly_once) header.tick = kExactlyOnce;
  header.run = run_.run;
  return json_lines::header(header);
}

// A start value may be as secret as the entry that it is of.
std::map<std::string, std::string, std::less<>> RunPackets::start_values() const {
  auto values = run_.values;
  if (!run_.entries) return values;
  std::erase_if(values, [&](const auto& it) {
    return std::ranges::find(*run_.entries, it.first) == run_.entries->end();
  });
  return values;
}

std::vector<ShapeEntry> RunPackets::entries_shown() const {
  std::vector<ShapeEntry> shown;
  for (const std::uint32_t slot : slots_) shown.push_back(shape_.entries[slot]);
  return shown;
}

void RunPackets::log(std::string_view who, std::string_view level, std::string_view text) {
  lines_.add(who, level, text);
}

void RunPackets::begin(const Moment& moment, std::span<const std::uint32_t> set) {
  entries_.begin(moment.entries, set);
  looked_ = moment.number;
}

// What came between two ticks shows only to who has looked at the first.
void RunPackets::before_tick(const Moment& moment) {
  delta_.before_tick(moment);
  if (looked_ == moment.number) entries_.before_tick(moment.entries);
}

Packet RunPackets::tick(const Moment& moment, const TickReport& report) {
  looked_ = moment.number;
  const std::span<const NodeChange> nodes = delta_.changes(moment);
  TickEnd end{.limits = delta_.limits(moment),
              .rounds = delta_.rounds(moment),
              .factors = delta_.factors(moment),
              .reasons = reasons(moment),
              .answers = run_.leaves_out_answers ? std::span<const GivenAnswer>() : moment.answers,
              .heard = delta_.heard(moment),
              .succeeded = delta_.succeeded(moment),
              .moments = moment.within,
              .faults = report.faults,
              .entries = entries_.changes(moment.entries),
              .logs = lines_.lines(),
              .is_full = is_full_};
  if (end.moments.empty()) end.moments.progress = delta_.own_progress();
  if (is_whole_) end.whole = entries_.values();
  json_lines::set_tick_end(line_end_, end);
  Packet packet{.nodes = nodes, .text = line_end_};
  has_events_ = delta_.has_turns() || !end.limits.empty() || !end.rounds.empty() ||
                !end.factors.empty() || !end.reasons.empty() || !end.answers.empty() ||
                !end.succeeded.empty() || !end.moments.empty() || !end.faults.empty() ||
                !end.entries.empty() || !end.logs.empty();
  packet.head.is_tick = 1;
  packet.head.tick = report.tick;
  packet.head.time = report.time.count();
  return packet;
}

std::span<const ReasonChange> RunPackets::reasons(const Moment& moment) {
  const std::span<const ReasonChange> all = delta_.reasons(moment);
  if (!run_.leaves_out_answers) return all;
  reasons_.assign(all.begin(), all.end());
  std::erase_if(reasons_,
                [&](const auto& it) { return shape_.nodes[it.node].question != nullptr; });
  return reasons_;
}

void RunPackets::keep() {
  delta_.keep();
  entries_.keep();
  lines_.keep();
  is_full_ = is_whole_ = false;
}

void RunPackets::add_whole() {
  delta_.add_whole();
  is_whole_ = true;
}

void RunPackets::start_over() {
  delta_.start_over();
  entries_.start_over();
  is_full_ = true;
}

std::string RunPackets::end(const Moment& moment, const RunEnd& end, std::uint64_t lost) {
  RecordedEnd closing{.result = std::string(to_string(end.result())),
                      .reason = std::string(to_string(end.reason)),
                      .fault = end.fault ? fault_text(shape_, *end.fault) : "",
                      .ticks = end.ticks,
                      .time = to_seconds(end.time),
                      .overruns = end.overruns,
                      .skipped = end.skipped,
                      .lost = lost};
  for (const Fault& fault : moment.live->tolerated()) {
    closing.notes.push_back(fault_text(shape_, fault, end.ticks));
  }
  std::ranges::move(progress_notes(shape_, *moment.live), std::back_inserter(closing.notes));
  if (end.reason == StopReason::Signal) closing.signal = end.signal;
  const auto lines = lines_.lines();
  closing.logs.assign(lines.begin(), lines.end());
  if (lines_.left_out() > 0) {
    closing.notes.push_back(
        fmt::format("{} that leaves logged are not recorded", counted(lines_.left_out(), "line")));
  }
  return json_lines::end(closing);
}

}  // namespace lockstep::host

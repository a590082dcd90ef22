#include "record/live/run_packets.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/core/version.h"
#include "base/core/wording.h"
#include "engine/writers.h"
#include "judge/summary/statistics.h"
#include "record/json_lines.h"
#include "record/live/watched_nodes.h"

namespace lockstep::host {
namespace {

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

RunPackets::RunPackets(const Tree& tree, RunDescription run)
    : tree_(tree),
      run_(std::move(run)),
      delta_(tree),
      slots_(slots_of(tree, run_.entries)),
      entries_(slots_) {
  const std::size_t repeating = repeating_nodes(tree).size();
  line_end_.reserve(json_lines::most_of_tick_end(
      tree.nodes.size(), delta_.most_succeeded() + tree.members.size() + repeating,
      2 * slots_.size()));
}

std::string RunPackets::header(const RunStart& start) const {
  RecordingHeader header;
  static_cast<Shape&>(header) = shape_of(tree_);
  header.entries = entries_shown(std::move(header.entries));
  header.file = run_.tree_file;
  header.version = kVersion;
  header.law = kLawVersion;
  header.rate_hz = run_.rate_hz;
  header.clock = start.real_time ? "wall" : "virtual";
  header.seed = run_.seed;
  header.arguments = run_.arguments;
  header.values = start_values();
  header.verify = run_.verify;
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

std::vector<ShapeEntry> RunPackets::entries_shown(std::vector<ShapeEntry> all) const {
  const auto who = writers(tree_);
  std::vector<ShapeEntry> shown;
  for (const std::uint32_t slot : slots_) {
    shown.push_back(std::move(all[slot]));
    shown.back().writers = who[slot];
  }
  return shown;
}

void RunPackets::log(std::string_view who, std::string_view level, std::string_view text) {
  lines_.add(who, level, text);
}

Packet RunPackets::tick(Ticker& ticker, const TickReport& report) {
  TickEnd end{.limits = delta_.limits(ticker),
              .rounds = delta_.rounds(ticker),
              .succeeded = delta_.succeeded(ticker),
              .moments = ticker.moments(),
              .faults = report.faults,
              .entries = entries_.changes(ticker.blackboard()),
              .logs = lines_.lines(),
              .is_full = is_full_};
  if (is_whole_) end.whole = entries_.values();
  json_lines::set_tick_end(line_end_, end);
  Packet packet{.nodes = delta_.changes(ticker), .text = line_end_};
  has_events_ = delta_.has_turns() || !end.limits.empty() || !end.rounds.empty() ||
                !end.succeeded.empty() || !end.moments.empty() || !end.faults.empty() ||
                !end.entries.empty() || !end.logs.empty();
  packet.head.is_tick = 1;
  packet.head.tick = report.tick;
  packet.head.time = report.time.count();
  return packet;
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

std::string RunPackets::end(const Ticker& ticker, const RunEnd& end, std::uint64_t lost) {
  RecordedEnd closing{.result = std::string(to_string(end.result())),
                      .reason = std::string(to_string(end.reason)),
                      .fault = end.fault ? fault_text(tree_, *end.fault) : "",
                      .ticks = end.ticks,
                      .time = to_seconds(end.time),
                      .overruns = end.overruns,
                      .skipped = end.skipped,
                      .lost = lost};
  for (const Fault& fault : ticker.tolerated()) {
    closing.notes.push_back(fault_text(tree_, fault, end.ticks));
  }
  std::ranges::move(progress_notes(ticker), std::back_inserter(closing.notes));
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

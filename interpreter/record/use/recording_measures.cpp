#include "record/use/recording_measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/core/diagnostics.h"
#include "base/core/value.h"
#include "base/json/json.h"
#include "base/terminal/text_table.h"
#include "judge/measure/measure_spec.h"
#include "judge/measure/measuring.h"
#include "judge/summary/summary.h"
#include "record/use/recorded_probe.h"

namespace lockstep::host {
namespace {

// '-' for what was not reached.
std::string text_of(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.6g}", value);
}

// A bool is 1 or 0.
double number_of(const RecordedEntry& entry) {
  const std::string text = entry.value.value_or("");
  if (text == "true" || text == "false") return text == "true" ? 1 : 0;
  return parse_double(text).value_or(kNoValue);
}

// The ticks of a recording, as measures see them.
class RecordedTicks {
 public:
  RecordedTicks(const RecordingHeader& header, const Measuring& measuring)
      : measuring_(measuring),
        parallel_ticks_(measuring.parallels().size()),
        node_ticks_(measuring.nodes().size()),
        user_ticks_(measuring.users().size()),
        numbers_(header.entries.size(), kNoValue),
        measured_numbers_(measuring.entries().size()) {
    parallels_.reserve(measuring.parallels().size());
    for (const NodeIndex node : measuring.parallels()) {
      parallels_.emplace_back(header, node);
    }
  }

  // Valid until the next call.
  TickView read(const RecordedTick& tick) {
    for (std::size_t i = 0; i < parallels_.size(); ++i) {
      parallel_ticks_[i] = parallels_[i].read(tick);
    }
    for (std::size_t i = 0; i < node_ticks_.size(); ++i) {
      const RecordedState& state = tick.nodes[measuring_.nodes()[i]];
      node_ticks_[i] = {state.ticked, state.status, state.progress};
    }
    for (std::size_t i = 0; i < user_ticks_.size(); ++i) {
      const RecordedState& state = tick.nodes[measuring_.users()[i]];
      user_ticks_[i] = {state.ticked, state.limit};
    }
    for (const RecordedEntry& entry : tick.entries) numbers_[entry.entry] = number_of(entry);
    for (std::size_t i = 0; i < measured_numbers_.size(); ++i) {
      measured_numbers_[i] = numbers_[measuring_.entries()[i]];
    }
    return {tick.tick,   from_seconds(tick.time), parallel_ticks_, node_ticks_,
            user_ticks_, measured_numbers_};
  }

 private:
  const Measuring& measuring_;
  std::vector<RecordedProbe> parallels_;
  std::vector<SynchronizedTick> parallel_ticks_;
  std::vector<NodeTick> node_ticks_;
  std::vector<ResourceTick> user_ticks_;
  std::vector<double> numbers_;  // of all entries
  std::vector<double> measured_numbers_;
};

}  // namespace

Result<std::vector<MeasuredValue>> measure_recording(RecordingReader& reader,
                                                     std::span<const MeasureSpec> measures) {
  const RecordingHeader& header = reader.header();
  Measuring measuring(header, measures);
  if (!measuring.error().empty()) return problem(measuring.error());
  RecordedTicks ticks(header, measuring);
  EndView end{.rate = header.rate_hz, .real_time = header.clock != "virtual"};
  while (const auto tick = reader.next()) {
    const TickView view = ticks.read(*tick);
    measuring.after_tick(view);
    end.ticks = view.tick + 1;
    end.last = view.time;
  }
  if (reader.end()) end.succeeded = reader.end()->result == to_string(RunResult::Success);
  if (reader.end()) end.ticks = reader.end()->ticks;
  if (reader.end()) end.ended = from_seconds(reader.end()->time);
  std::vector<MeasuredValue> values;
  for (std::size_t column = 0; column < measuring.columns().size(); ++column) {
    const auto& [spec, node] = measuring.columns()[column];
    values.push_back({node, spec, measuring.value(column, end), {}});
    if (spec->measure->has_gap) values.back().gap = measuring.gap(column);
  }
  return values;
}

std::string to_json(std::span<const MeasuredValue> values) {
  Json json = Json::array();
  for (const MeasuredValue& value : values) {
    json.push_back(
        {{"node", value.node}, {"measure", to_text(*value.measure)}, {"value", value.value}});
    if (value.gap) json.back()["gap"] = *value.gap;
  }
  return json.printable();
}

std::string to_table(std::span<const MeasuredValue> values, std::size_t width) {
  const bool has_gaps =
      std::ranges::any_of(values, [](const auto& it) { return it.gap.has_value(); });
  std::vector<TableRow> rows = {{"node", "measure", "value", has_gaps ? "gap" : ""}};
  for (const MeasuredValue& value : values) {
    rows.push_back({printable(value.node), printable(to_text(*value.measure)), text_of(value.value),
                    value.gap ? text_of(*value.gap) : ""});
  }
  return text_table(rows, rows.front().size(), width);
}

}  // namespace lockstep::host

#include "record/use/recording_measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/core/diagnostics.h"
#include "base/json/json.h"
#include "base/terminal/text_table.h"
#include "judge/measure/measure_spec.h"
#include "judge/measure/measuring.h"
#include "judge/summary/summary.h"
#include "record/read/recorded_moments.h"
#include "record/use/recorded_joints.h"

namespace lockstep::host {
namespace {

// '-' for what was not reached.
std::string text_of(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.6g}", value);
}

}  // namespace

Result<std::vector<MeasuredValue>> measure_recording(RecordingReader& reader,
                                                     std::span<const MeasureSpec> measures) {
  const RecordingHeader& header = reader.header();
  Measuring measuring(header, measures);
  if (!measuring.error().empty()) return problem(measuring.error());
  RecordedMoments moments(header);
  RecordedJoints joints(reader);
  EndView end{.rate = header.rate_hz, .real_time = header.clock != "virtual"};
  while (const auto tick = reader.next()) {
    if (const auto joint = joints.before(*tick)) measuring.join(*joint);
    const Moment& moment = moments.read(*tick);
    measuring.after_tick(moment);
    end.ticks = moment.tick + 1;
    end.last = moment.time;
  }
  if (reader.end()) end.succeeded = reader.end()->result == to_string(RunResult::Success);
  if (reader.end()) end.ticks = reader.end()->ticks;
  if (reader.end()) end.ended = from_seconds(reader.end()->time);
  std::vector<MeasuredValue> values;
  for (std::size_t column = 0; column < measuring.columns().size(); ++column) {
    const auto& [spec, node] = measuring.columns()[column];
    const Measure& measure = *spec->measure;
    const bool is_unknown = header.first_tick > 0 && measure.counts_from_start != nullptr &&
                            measure.counts_from_start(*spec);
    values.push_back({node, spec, is_unknown ? kNoValue : measuring.value(column, end), {}});
    if (measure.has_gap) values.back().gap = is_unknown ? kNoValue : measuring.gap(column);
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

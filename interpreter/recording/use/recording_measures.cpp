#include "recording/use/recording_measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/diagnostics.h"
#include "core/printable_json.h"
#include "measure/predictability.h"
#include "recording/use/recorded_probe.h"

namespace lockstep {
namespace {

// '-' for what was not reached.
std::string text_of(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.6g}", value);
}

std::vector<std::string> paths_of(const RecordingHeader& header) {
  std::vector<std::string> paths;
  for (const RecordedNode& node : header.nodes) paths.push_back(node.path);
  return paths;
}

class Instant {
 public:
  Instant(const MeasureSpec& measure, std::size_t node)
      : node_(node), measure_(measure.progress, measure.expected.value_or(0)) {}

  void after_tick(const RecordedTick& tick) {
    const RecordedState& state = tick.nodes[node_];
    measure_.after_tick(tick.tick, state.progress, state.ticked, state.status);
  }
  MeasuredValue value(const RecordingHeader& header, const MeasureSpec& measure) const {
    return {header.nodes[node_].path, measure, measure_.value(), measure_.gap()};
  }

 private:
  std::size_t node_;
  Predictability measure_;
};

// Feeds each tick to what was asked for.
class Measuring {
 public:
  // A node that is not there is told in `error`.
  Measuring(const RecordingHeader& header, std::span<const MeasureSpec> measures,
            std::string& error)
      : header_(header), period_(period_of(header)), nodes_(measures_of(header)) {
    const auto paths = paths_of(header);
    for (const MeasureSpec& measure : measures) {
      if (measure.kind != MeasureKind::Predictability) continue;
      const auto node = find_path(paths, measure.node, error);
      if (!node) return;
      instants_.emplace_back(measure, *node);
    }
  }

  void after_tick(const RecordedTick& tick) {
    // A tick lasts until the next would begin, also the last.
    duration_ = to_seconds(from_seconds(tick.time) + period_);
    for (RecordedMeasure& node : nodes_) node.after_tick(tick);
    for (Instant& instant : instants_) instant.after_tick(tick);
  }

  std::vector<MeasuredValue> values(std::span<const MeasureSpec> measures) {
    std::vector<MeasuredValue> values;
    auto instant = instants_.begin();
    for (const MeasureSpec& measure : measures) {
      switch (measure.kind) {
        case MeasureKind::ProgressDistance:
          add_of_nodes(measure, &ProgressDistance::sum, values);
          break;
        case MeasureKind::StepLength:
          add_of_nodes(measure, &ProgressDistance::step_length, values);
          break;
        case MeasureKind::Duration:
          values.push_back({header_.tree, measure, duration_, {}});
          break;
        case MeasureKind::Predictability:
          values.push_back((instant++)->value(header_, measure));
          break;
      }
    }
    return values;
  }

 private:
  void add_of_nodes(const MeasureSpec& measure, double (ProgressDistance::*number)() const,
                    std::vector<MeasuredValue>& values) const {
    for (const RecordedMeasure& node : nodes_) {
      const ProgressDistance& distance = node.measure.distance();
      const bool reached = distance.samples() > 0;
      values.push_back({header_.nodes[node.probe.node()].path,
                        measure,
                        reached ? (distance.*number)() : std::numeric_limits<double>::quiet_NaN(),
                        {}});
    }
  }

  const RecordingHeader& header_;
  Nanoseconds period_;
  std::vector<RecordedMeasure> nodes_;
  std::vector<Instant> instants_;
  double duration_ = 0;
};

}  // namespace

std::vector<MeasuredValue> measure_recording(RecordingReader& reader,
                                             std::span<const MeasureSpec> measures,
                                             std::string& error) {
  Measuring measuring(reader.header(), measures, error);
  if (!error.empty()) return {};
  while (const auto tick = reader.next()) measuring.after_tick(*tick);
  return measuring.values(measures);
}

std::string to_json(std::span<const MeasuredValue> values) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const MeasuredValue& value : values) {
    json.push_back(
        {{"node", value.node}, {"measure", to_text(value.measure)}, {"value", value.value}});
    if (value.gap) json.back()["gap"] = *value.gap;
  }
  return printable_json(
      json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

std::string to_table(std::span<const MeasuredValue> values) {
  using Row = std::array<std::string, 4>;
  const bool has_gaps =
      std::ranges::any_of(values, [](const auto& it) { return it.gap.has_value(); });
  std::vector<Row> rows = {{"node", "measure", "value", has_gaps ? "gap" : ""}};
  for (const MeasuredValue& value : values) {
    rows.push_back({printable(value.node), printable(to_text(value.measure)), text_of(value.value),
                    value.gap ? text_of(*value.gap) : ""});
  }
  std::array<std::size_t, 3> widths{};
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Row& row : rows) {
    text += fmt::format("{:<{}}  {:<{}}  ", row[0], widths[0], row[1], widths[1]);
    text += row[3].empty() ? row[2] : fmt::format("{:<{}}  {}", row[2], widths[2], row[3]);
    text += '\n';
  }
  return text;
}

}  // namespace lockstep

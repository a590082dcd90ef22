#include "observers/recording_measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/diagnostics.h"
#include "measure/predictability.h"
#include "observers/recorded_probe.h"

namespace lockstep {
namespace {

class Synchronized {
 public:
  Synchronized(const RecordingHeader& header, NodeIndex node)
      : probe_(header, node), measure_(probe_.children().size()) {}

  NodeIndex node() const { return probe_.node(); }
  void after_tick(const RecordedTick& tick) { measure_.after_tick(probe_.read(tick)); }
  double value(MeasureKind kind) const {
    if (kind == MeasureKind::ProgressDistance) return measure_.distance().sum();
    if (kind == MeasureKind::StepLength) return measure_.distance().step_length();
    return to_seconds(measure_.duration());
  }

 private:
  RecordedProbe probe_;
  SynchronizedMeasure measure_;
};

class Instant {
 public:
  Instant(const MeasureSpec& measure, std::size_t node)
      : node_(node), expected_(measure.expected), nearest_(measure.progress) {}

  std::size_t node() const { return node_; }
  void after_tick(const RecordedTick& tick) {
    const RecordedState& state = tick.nodes[node_];
    nearest_.sample(static_cast<double>(tick.tick), state.progress);
    ticks_ = static_cast<double>(tick.tick + 1);
    succeeded_ = state.status == Status::Success;
  }
  double value() {
    // No tick follows the last: what the node reached in it would not be seen.
    if (succeeded_) nearest_.sample(ticks_, 1);
    return nearest_.time() - expected_.value_or(0);
  }

 private:
  std::size_t node_;
  std::optional<double> expected_;
  NearestInstant nearest_;
  double ticks_ = 0;
  bool succeeded_ = false;
};

bool is_instant(const MeasureSpec& measure) {
  return measure.kind == MeasureKind::Predictability;
}

std::vector<std::string> paths_of(const RecordingHeader& header) {
  std::vector<std::string> paths;
  for (const RecordedNode& node : header.nodes) paths.push_back(node.path);
  return paths;
}

}  // namespace

std::vector<MeasuredValue> measure_recording(RecordingReader& reader,
                                             std::span<const MeasureSpec> measures,
                                             std::string& error) {
  const auto paths = paths_of(reader.header());
  std::vector<Synchronized> nodes;
  for (const NodeIndex node : synchronized_nodes(reader.header())) {
    nodes.emplace_back(reader.header(), node);
  }
  std::vector<Instant> instants;
  for (const MeasureSpec& measure : measures) {
    if (!is_instant(measure)) continue;
    const auto node = find_path(paths, measure.node, error);
    if (!node) return {};
    instants.emplace_back(measure, *node);
  }
  while (const auto tick = reader.next()) {
    for (Synchronized& node : nodes) node.after_tick(*tick);
    for (Instant& instant : instants) instant.after_tick(*tick);
  }
  std::vector<MeasuredValue> values;
  for (const Synchronized& node : nodes) {
    for (const MeasureSpec& measure : measures) {
      if (is_instant(measure)) continue;
      values.push_back({paths[node.node()], measure, node.value(measure.kind)});
    }
  }
  auto instant = instants.begin();
  for (const MeasureSpec& measure : measures) {
    if (!is_instant(measure)) continue;
    values.push_back({paths[instant->node()], measure, instant->value()});
    ++instant;
  }
  return values;
}

std::string to_json(std::span<const MeasuredValue> values) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const MeasuredValue& value : values) {
    json.push_back(
        {{"node", value.node}, {"measure", to_text(value.measure)}, {"value", value.value}});
  }
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string to_table(std::span<const MeasuredValue> values) {
  struct Row {
    std::string node, measure;
  };
  std::vector<Row> rows = {{"node", "measure"}};
  std::size_t node_width = 0, measure_width = 0;
  for (const MeasuredValue& value : values) {
    rows.push_back({printable(value.node), printable(to_text(value.measure))});
  }
  for (const Row& row : rows) {
    node_width = std::max(node_width, row.node.size());
    measure_width = std::max(measure_width, row.measure.size());
  }
  std::string text = fmt::format("{:<{}}  {:<{}}  value\n", rows[0].node, node_width,
                                 rows[0].measure, measure_width);
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += fmt::format("{:<{}}  {:<{}}  {:.6g}\n", rows[i + 1].node, node_width,
                        rows[i + 1].measure, measure_width, values[i].value);
  }
  return text;
}

}  // namespace lockstep

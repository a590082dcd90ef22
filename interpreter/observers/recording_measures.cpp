#include "observers/recording_measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/diagnostics.h"
#include "core/printable_json.h"
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
    const bool is_sum = kind == MeasureKind::ProgressDistance;
    return is_sum ? measure_.distance().sum() : measure_.distance().step_length();
  }

 private:
  RecordedProbe probe_;
  SynchronizedMeasure measure_;
};

std::vector<std::string> paths_of(const RecordingHeader& header) {
  std::vector<std::string> paths;
  for (const RecordedNode& node : header.nodes) paths.push_back(node.path);
  return paths;
}

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

// Feeds each tick to what was asked for.
class Measuring {
 public:
  // A node that is not there is told in `error`.
  Measuring(const RecordingHeader& header, std::span<const MeasureSpec> measures,
            std::string& error)
      : header_(header),
        period_(header.rate_hz > 0 ? from_seconds(1 / header.rate_hz) : Nanoseconds(0)) {
    for (const NodeIndex node : synchronized_nodes(header)) nodes_.emplace_back(header, node);
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
    for (Synchronized& node : nodes_) node.after_tick(tick);
    for (Instant& instant : instants_) instant.after_tick(tick);
  }

  std::vector<MeasuredValue> values(std::span<const MeasureSpec> measures) {
    std::vector<MeasuredValue> values;
    auto instant = instants_.begin();
    for (const MeasureSpec& measure : measures) {
      if (measure.kind == MeasureKind::Duration) {
        values.push_back({header_.tree, measure, duration_});
      } else if (measure.kind == MeasureKind::Predictability) {
        values.push_back({header_.nodes[instant->node()].path, measure, instant->value()});
        ++instant;
      } else {
        for (const Synchronized& node : nodes_) {
          values.push_back({header_.nodes[node.node()].path, measure, node.value(measure.kind)});
        }
      }
    }
    return values;
  }

 private:
  const RecordingHeader& header_;
  Nanoseconds period_;
  std::vector<Synchronized> nodes_;
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
  }
  return printable_json(
      json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
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

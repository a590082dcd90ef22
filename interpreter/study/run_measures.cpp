#include "study/run_measures.h"

#include <algorithm>
#include <utility>

#include "engine/synchronized.h"
#include "measure/synchronized_measure.h"

namespace lockstep {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::optional<NodeIndex> find_node(const Tree& tree, const std::string& name, std::string& error) {
  std::vector<std::string> paths;
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    paths.push_back(tree.path(node));
  }
  const auto found = find_path(paths, name, error);
  if (found) return static_cast<NodeIndex>(*found);
  return std::nullopt;
}

}  // namespace

RunMeasures::RunMeasures(const Tree& tree, std::span<const MeasureSpec> measures, double rate)
    : rate_(rate) {
  for (const MeasureSpec& measure : measures) {
    switch (measure.kind) {
      case MeasureKind::ProgressDistance:
      case MeasureKind::StepLength:
        add_distances(tree, measure);
        break;
      case MeasureKind::Duration:
        durations_.push_back(add_column(measure, tree.id));
        break;
      case MeasureKind::Predictability:
        add_instant(tree, measure);
        break;
    }
  }
}

std::size_t RunMeasures::add_column(const MeasureSpec& measure, std::string node) {
  columns_.push_back({to_text(measure), std::move(node)});
  values_.push_back(kNone);
  return columns_.size() - 1;
}

void RunMeasures::add_distances(const Tree& tree, const MeasureSpec& measure) {
  if (distances_.empty()) {
    for (const NodeIndex node : synchronized_nodes(tree)) {
      distances_.push_back({node, ProgressDistance(tree.nodes[node].children), {}, {}});
    }
  }
  for (Distance& distance : distances_) {
    const std::size_t column = add_column(measure, tree.path(distance.node));
    const bool is_sum = measure.kind == MeasureKind::ProgressDistance;
    (is_sum ? distance.sum : distance.step_length) = column;
  }
}

void RunMeasures::add_instant(const Tree& tree, const MeasureSpec& measure) {
  const auto node = find_node(tree, measure.node, error_);
  if (!node) return;
  Instant instant{.node = *node,
                  .parent = {},
                  .child = 0,
                  .measure = Predictability(measure.progress, measure.expected.value_or(0)),
                  .column = add_column(measure, tree.path(*node))};
  columns_[add_column(measure, tree.path(*node))].is_gap = true;
  const NodeIndex parent = tree.labels[*node].parent;
  if (synchronization(tree.nodes[parent]) != Synchronization::None && parent != *node) {
    const auto children = children_of(tree, parent);
    instant.parent = parent;
    instant.child = static_cast<std::size_t>(std::ranges::find(children, *node) - children.begin());
  }
  instants_.push_back(instant);
}

void RunMeasures::run_started(Ticker&, const RunStart&) {
  for (Distance& distance : distances_) distance.measure.reset();
  for (Instant& instant : instants_) instant.measure.reset();
  std::ranges::fill(values_, kNone);
}

void RunMeasures::before_tick(Ticker& ticker, std::uint64_t, Nanoseconds) {
  for (Instant& instant : instants_) instant.seen = ticker.progress(instant.node);
}

void RunMeasures::after_tick(Ticker& ticker, const TickReport& report) {
  for (Distance& distance : distances_) {
    const bool ticked = ticker.ticked(distance.node);
    const bool done = ticked && succeeded(ticker, distance.node);
    distance.measure.after_tick(
        ticked, done ? Status::Success : ticker.status(distance.node),
        ticked ? child_progress(ticker, distance.node) : std::span<const double>());
  }
  for (Instant& instant : instants_) {
    // What a synchronized node has seen counts more than what was seen before its tick.
    if (instant.parent && ticker.ticked(*instant.parent)) {
      instant.seen = child_progress(ticker, *instant.parent)[instant.child];
    }
    instant.measure.after_tick(report.tick, instant.seen, ticker.ticked(instant.node),
                               ticker.status(instant.node));
  }
}

void RunMeasures::run_ended(Ticker&, const RunEnd& end) {
  for (const Distance& distance : distances_) {
    const ProgressDistance& measured = distance.measure;
    if (measured.samples() == 0) continue;  // no tick reached the node
    if (distance.sum) values_[*distance.sum] = measured.sum();
    if (distance.step_length) values_[*distance.step_length] = measured.step_length();
  }
  for (const Instant& instant : instants_) {
    values_[instant.column] = instant.measure.value();
    values_[instant.column + 1] = instant.measure.gap();
  }
  for (const std::size_t column : durations_) {
    values_[column] = static_cast<double>(end.ticks) / rate_;
  }
}

}  // namespace lockstep

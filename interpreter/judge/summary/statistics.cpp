#include "judge/summary/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "trace/progress_text.h"

namespace lockstep::host {

Statistics::Statistics(Shape shape) : shape_(std::move(shape)), nodes_(measured_nodes(shape_)) {}

void Statistics::join() {
  for (MeasuredNode& node : nodes_) node.measure.join(Joint::Lost);
}

void Statistics::run_started(const Moment&, const RunStart& start) {
  real_time_ = start.real_time;
}

void Statistics::after_tick(const Moment& moment, const TickReport& report) {
  if (last_start_) periods_.record(report.time - *last_start_);
  last_start_ = report.time;
  lateness_.record(report.late);
  for (MeasuredNode& node : nodes_) node.after_tick(moment);
  for (const Fault& fault : report.faults) note(fault, report.tick);
  why_.after_tick(moment);
  if (report.status == Status::Failure) why_failed_ = why_.why(moment);
}

void Statistics::note(const Fault& fault, std::uint64_t tick) {
  faults_.add([&] { return fault_text(shape_, fault, tick); });
}

void Statistics::run_ended(const Moment& moment, const RunEnd& end) {
  end_ = end;
  for (const Fault& fault : moment.live->tolerated()) note(fault, end.ticks);
  progress_notes_ = progress_notes(shape_, *moment.live);
  went_on_ = moment.live->went_on().size();
  for (MeasuredNode& node : nodes_) node.measure.run_ended(end.time);
}

Summary Statistics::summary() const {
  Summary summary{.result = end_.result(),
                  .reason = end_.reason,
                  .signal = end_.signal,
                  .fault = end_.fault ? fault_text(shape_, *end_.fault) : "",
                  .ticks = end_.ticks,
                  .seconds = to_seconds(end_.time),
                  .overruns = end_.overruns,
                  .skipped = end_.skipped,
                  .worst = worst_tick(),
                  .faults = faults_.count(),
                  .went_on = went_on_};
  faults_.append_to(summary.notes);
  summary.notes.insert(summary.notes.end(), progress_notes_.begin(), progress_notes_.end());
  for (const MeasuredNode& node : nodes_) append_fall_notes(shape_, node, summary.notes);
  if (real_time_ && periods_.count() > 0) {
    summary.period = PeriodSummary{.p50 = to_seconds(periods_.quantile(0.5)),
                                   .p99 = to_seconds(periods_.quantile(0.99)),
                                   .max = to_seconds(periods_.max())};
  }
  if (real_time_ && lateness_.count() > 0) {
    summary.lateness = LatenessSummary{.p50 = to_seconds(lateness_.quantile(0.5)),
                                       .p99 = to_seconds(lateness_.quantile(0.99)),
                                       .max = to_seconds(lateness_.max()),
                                       .ticks = lateness_.by_digits()};
  }
  summary.why_failed = summarize(why_failed_, shape_);
  for (const MeasuredNode& node : nodes_) {
    if (node.measure.distance().samples() > 0) {
      summary.synchronized_nodes.push_back(summary_of(node));
    }
  }
  summary.never_reached = nodes_.size() - summary.synchronized_nodes.size();
  return summary;
}

std::optional<WorstTickSummary> Statistics::worst_tick() const {
  const WorstTick& worst = end_.worst;
  if (!real_time_ || worst.took == Nanoseconds(0)) return std::nullopt;
  return WorstTickSummary{.tick = worst.tick,
                          .took = to_seconds(worst.took),
                          .leaf = worst.leaf ? shape_.nodes[*worst.leaf].path : "",
                          .leaf_took = to_seconds(worst.leaf_took)};
}

SynchronizedSummary Statistics::summary_of(const MeasuredNode& measured) const {
  const NodeIndex index = measured.ticks.node();
  const ShapeNode& node = shape_.nodes[index];
  return summarize(measured.measure, node.path, node.kind, child_names(shape_, index));
}

std::string describe_node(const Shape& shape, NodeIndex node) {
  const NodeType& type = *shape.nodes[node].type;
  if (type.leaf == nullptr)
    return fmt::format("the node '{}' ({})", shape.nodes[node].path, type.id);
  return fmt::format("the {} '{}' ({} of plugin '{}')", type.arity.max == 0 ? "leaf" : "node",
                     shape.nodes[node].path, type.id, type.plugin);
}

std::string failure_text(const Fault& fault, std::uint64_t ticks, std::uint64_t first_tick) {
  if (fault.in_last_halt) return "could not be halted at the end of the run";
  if (ticks == first_tick) return "failed before the first tick";
  return fmt::format("failed in tick {}", ticks - 1);
}

std::string fault_text(const Shape& shape, const Fault& fault, std::uint64_t tick) {
  const std::string path = shape.nodes[fault.node].path;
  if (fault.in_last_halt) {
    return fmt::format("the leaf '{}' could not be halted: {}", path, fault.message);
  }
  return fmt::format("the leaf '{}' failed in tick {}: {}; counted as Failure", path, tick,
                     fault.message);
}

std::string fault_text(const Shape& shape, const Fault& fault) {
  return fmt::format("{}: {}{}", shape.nodes[fault.node].path, fault.in_last_halt ? kNotHalted : "",
                     fault.message);
}

std::vector<std::string> progress_notes(const Shape& shape, const LiveRun& run) {
  constexpr std::size_t kMostLeaves = 5;
  std::vector<std::string> notes;
  const auto add = [&](const auto& all, const char* more, auto text_of) {
    for (const auto& it : all.first(std::min(all.size(), kMostLeaves))) {
      notes.push_back(fmt::format("the leaf '{}' {}", shape.nodes[it.node].path, text_of(it)));
    }
    if (all.size() <= kMostLeaves) return;
    notes.push_back(fmt::format("{} leaves in all {}", all.size(), more));
  };
  add(run.out_of_range(), "reported such a progress",
      [](const OutOfRange& it) { return out_of_range_text(it.reported); });
  add(run.went_on(), "continued while they were held",
      [](const WentOn& it) { return went_on_text(it.from, it.to); });
  return notes;
}

}  // namespace lockstep::host

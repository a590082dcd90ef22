#include "observers/statistics.h"

namespace lockstep {

Statistics::Statistics(const Tree& tree) : tree_(tree) {
  for (const NodeIndex node : synchronized_nodes(tree)) {
    nodes_.push_back(
        {SynchronizedProbe(tree, node), SynchronizedMeasure(tree.nodes[node].children)});
  }
}

void Statistics::run_started(Ticker&, const RunStart& start) {
  real_time_ = start.real_time;
}

void Statistics::after_tick(Ticker& ticker, const TickReport& report) {
  if (report.tick > 0) periods_.record(report.time - last_start_);
  last_start_ = report.time;
  for (Measured& node : nodes_) node.measure.after_tick(node.probe.read(ticker, report.time));
}

void Statistics::run_ended(Ticker& ticker, const RunEnd& end) {
  end_ = end;
  fault_ = fault_text(ticker);
  for (Measured& node : nodes_) node.measure.run_ended(end.time);
}

Summary Statistics::summary() const {
  Summary summary{.status = end_.status,
                  .reason = end_.reason,
                  .signal = end_.signal,
                  .fault = fault_,
                  .ticks = end_.ticks,
                  .seconds = to_seconds(end_.time),
                  .period = {},
                  .overruns = end_.overruns,
                  .skipped = end_.skipped,
                  .synchronized_nodes = {},
                  .notes = {}};
  if (real_time_ && periods_.count() > 0) {
    summary.period = PeriodSummary{.p50 = to_seconds(periods_.quantile(0.5)),
                                   .p99 = to_seconds(periods_.quantile(0.99)),
                                   .max = to_seconds(periods_.max())};
  }
  for (const Measured& node : nodes_) summary.synchronized_nodes.push_back(summary_of(node));
  return summary;
}

SynchronizedSummary Statistics::summary_of(const Measured& measured) const {
  std::vector<std::string> children;
  for (const NodeIndex child : measured.probe.children()) {
    children.push_back(tree_.labels[child].segment);
  }
  const NodeIndex node = measured.probe.node();
  return summarize(measured.measure, tree_.path(node), std::string(tree_.labels[node].type->id),
                   children);
}

std::string fault_text(const Ticker& ticker) {
  const Fault* fault = ticker.fault();
  return fault == nullptr ? "" : ticker.tree().path(fault->node) + ": " + fault->message;
}

}  // namespace lockstep

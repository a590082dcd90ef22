#include <utility>

#include "observers/recorded_probe.h"
#include "study/progress_plot.h"

namespace lockstep {
namespace {

// Collects the samples of one node.
class Collector {
 public:
  Collector(const RecordingHeader& header, NodeIndex node, std::vector<NodeIndex> children)
      : probe_(header, node, std::move(children)), period_(period_of(header)) {
    plot_.index = node;
    plot_.node = header.nodes[node];
    plot_.children = probe_.names();
  }

  void after_tick(const RecordedTick& recorded) {
    const SynchronizedTick tick = probe_.read(recorded);
    if (tick.ticked) add(recorded.time, tick);
    running_ = tick.status == Status::Running;
    // What the last tick of an activation led to is in no later sample of it.
    if (tick.ticked && !running_) add_end(recorded);
  }

  ProgressPlot plot() && { return std::move(plot_); }

 private:
  void add(double time, const SynchronizedTick& tick) {
    plot_.samples.push_back({.time = time,
                             .begins = !running_,
                             .progress = {tick.progress.begin(), tick.progress.end()},
                             .held = {tick.held.begin(), tick.held.end()}});
  }

  void add_end(const RecordedTick& recorded) {
    ProgressSample end = plot_.samples.back();
    end.time = to_seconds(from_seconds(recorded.time) + period_);
    end.begins = false;
    for (std::size_t child = 0; child < probe_.children().size(); ++child) {
      if (recorded.nodes[probe_.children()[child]].status == Status::Success) {
        end.progress[child] = 1;
      }
      end.held[child] = false;
    }
    plot_.samples.push_back(std::move(end));
  }

  RecordedProbe probe_;
  Nanoseconds period_;
  ProgressPlot plot_;
  bool running_ = false;
};

}  // namespace

std::vector<ProgressPlot> progress_plots(RecordingReader& reader,
                                         std::span<const NodeIndex> nodes) {
  const auto children = children_of(reader.header());
  std::vector<Collector> collectors;
  for (const NodeIndex node : nodes) {
    collectors.emplace_back(reader.header(), node, children[node]);
  }
  while (const auto tick = reader.next()) {
    for (Collector& collector : collectors) collector.after_tick(*tick);
  }
  std::vector<ProgressPlot> plots;
  for (Collector& collector : collectors) plots.push_back(std::move(collector).plot());
  return plots;
}

}  // namespace lockstep

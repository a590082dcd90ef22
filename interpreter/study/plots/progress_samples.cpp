#include <algorithm>
#include <utility>

#include "judge/measure/synchronized_ticks.h"
#include "record/read/recorded_moments.h"
#include "study/plots/plot_style.h"
#include "study/plots/progress_plot.h"

namespace lockstep::host {
namespace {

// All plots together keep no more numbers than this, however many nodes and children there are.
constexpr std::size_t kMostNumbers = std::size_t{8} << 20u;
constexpr std::size_t kFewestColumns = 16;
// Samples for a column. Those that are read are thinned when they are twice as many as stay.
constexpr std::size_t kKeptPerColumn = 2 * kMostPerColumn;

std::vector<std::string> drawn_children(const Shape& shape, NodeIndex node) {
  std::vector<std::string> names = child_names(shape, node);
  names.resize(std::min(names.size(), kPlotStyles));
  return names;
}

// Twice as many as pixels: a PNG has so many.
std::size_t columns_for(PlotSize size, std::size_t plots, std::size_t children) {
  constexpr std::size_t kOfSample = 10;  // numbers, beside those of its children
  const std::size_t of_column = kKeptPerColumn * (2 * children + kOfSample);
  return std::clamp(kMostNumbers / plots / of_column, kFewestColumns,
                    2 * static_cast<std::size_t>(size.width));
}

// Collects the samples of one node.
class Collector {
 public:
  Collector(const RecordingHeader& header, NodeIndex node, std::size_t plots, PlotSize size)
      : ticks_(header, node), period_(period_of(header)) {
    plot_.index = node;
    plot_.node = header.nodes[node];
    plot_.children = drawn_children(header, node);
    plot_.all_children = ticks_.children().size();
    columns_ = columns_for(size, plots, plot_.children.size());
  }

  void after_tick(const Moment& moment) {
    const SynchronizedTick tick = ticks_.read(moment);
    if (tick.ticked) add(moment, tick);
    running_ = tick.status == Status::Running;
    // The last tick of an activation has no later sample that shows its result.
    if (tick.ticked && !running_) add_end(moment, tick);
  }

  ProgressPlot plot() && {
    if (plot_.samples.size() > kMostPerColumn * columns_) thin(plot_.samples, columns_);
    return std::move(plot_);
  }

 private:
  std::size_t drawn() const { return plot_.children.size(); }

  void add(const Moment& moment, const SynchronizedTick& tick) {
    const double time = to_seconds(moment.time);
    if (running_) hold_until(time);
    const auto all = tick.used;
    push({.time = time,
          .begins = !running_,
          .least = least_progress(all),
          .limit = tick.limit,
          .progress = {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(drawn())},
          .held_until = std::vector<double>(drawn(), time),
          .factor = factors(moment)});
    held_.assign(tick.held.begin(), tick.held.begin() + static_cast<std::ptrdiff_t>(drawn()));
  }

  std::vector<double> factors(const Moment& moment) const {
    std::vector<double> factors;
    if (!plot_.node.paces) return factors;
    for (const NodeIndex child : ticks_.children()) {
      if (factors.size() < drawn()) factors.push_back(moment.factor(child));
    }
    return factors;
  }

  // Those that the last sample found held were so until now. When the node was halted in between,
  // nobody knows until when.
  void hold_until(double time) {
    ProgressSample& last = plot_.samples.back();
    for (std::size_t child = 0; child < held_.size(); ++child) {
      if (held_[child]) last.held_until[child] = time;
    }
  }

  void add_end(const Moment& moment, const SynchronizedTick& tick) {
    const double time = to_seconds(moment.time + period_);
    hold_until(time);
    ProgressSample end = plot_.samples.back();
    end.time = time;
    end.begins = false;
    std::ranges::fill(end.held_until, time);
    end.least = 1;
    for (std::size_t child = 0; child < ticks_.children().size(); ++child) {
      const bool succeeded = moment.status(ticks_.children()[child]) == Status::Success;
      const double progress = succeeded ? 1.0 : tick.used[child];
      end.least = std::min(end.least, progress);
      if (child < drawn()) end.progress[child] = progress;
    }
    push(std::move(end));
    held_.clear();
  }

  void push(ProgressSample sample) {
    plot_.samples.push_back(std::move(sample));
    if (plot_.samples.size() >= kKeptPerColumn * columns_) thin(plot_.samples, columns_);
  }

  SynchronizedTicks ticks_;
  Nanoseconds period_;
  ProgressPlot plot_;
  std::size_t columns_ = 0;
  std::vector<bool> held_;  // in the last sample, of each child that is drawn
  bool running_ = false;
};

}  // namespace

std::vector<ProgressPlot> progress_plots(RecordingReader& reader, std::span<const NodeIndex> nodes,
                                         PlotSize size) {
  std::vector<Collector> collectors;
  for (const NodeIndex node : nodes) {
    collectors.emplace_back(reader.header(), node, nodes.size(), size);
  }
  RecordedMoments moments(reader.header());
  while (const auto tick = reader.next()) {
    const Moment& moment = moments.read(*tick);
    for (Collector& collector : collectors) collector.after_tick(moment);
  }
  std::vector<ProgressPlot> plots;
  for (Collector& collector : collectors) plots.push_back(std::move(collector).plot());
  return plots;
}

}  // namespace lockstep::host

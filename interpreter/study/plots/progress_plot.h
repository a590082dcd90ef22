// The progress of the children of a synchronized node over the time of a recorded run, with its
// barriers or its band of delta, and when each child was held. What `lockstep log plot` draws.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "record/read/recording_reader.h"
#include "study/plots/plot.h"
#include "study/plots/progress_sample.h"

namespace lockstep::host {

struct ProgressPlot {
  NodeIndex index = 0;  // in the recording
  ShapeNode node;
  std::vector<std::string> children;  // the names of those that are drawn
  std::size_t all_children = 0;       // how many the node has
  std::vector<ProgressSample> samples;
};

// One plot for each of the nodes, which must be synchronized ones, of their first kPlotStyles
// children, with the samples that a picture of this size can show. Reads to the end; then look at
// reader.error(). A node that no tick reached has no samples.
std::vector<ProgressPlot> progress_plots(RecordingReader& reader, std::span<const NodeIndex> nodes,
                                         PlotSize size = {});

// Writes `image`, whose extension is .svg or .png, and beside it the .dat and the .gp. There must
// be a sample.
PlotResult draw(const ProgressPlot& plot, const std::filesystem::path& image, PlotSize size = {});

// The text of the two files, for draw() and its tests.
std::string progress_plot_data(const ProgressPlot& plot);
std::string progress_plot_script(const ProgressPlot& plot, const std::filesystem::path& image,
                                 PlotSize size);

}  // namespace lockstep::host

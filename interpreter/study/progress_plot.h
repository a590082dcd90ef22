// The progress of the children of a synchronized node over the time of a recorded run, with its
// barriers or its band of delta, and when each child was held. What `lockstep log plot` draws.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "observers/recording_reader.h"
#include "study/plot.h"

namespace lockstep {

struct ProgressSample {
  double time = 0;               // seconds
  bool begins = false;           // a new activation of the node: no line leads here
  std::vector<double> progress;  // of each child
  std::vector<bool> held;        // of each child; from here to the next sample
};

struct ProgressPlot {
  NodeIndex index = 0;  // in the recording
  RecordedNode node;
  std::vector<std::string> children;  // their names
  std::vector<ProgressSample> samples;
};

// One plot for each of the nodes, which must be synchronized ones. Reads to the end; then look at
// reader.error(). A node that no tick reached has no samples.
std::vector<ProgressPlot> progress_plots(RecordingReader& reader, std::span<const NodeIndex> nodes);

// Writes `image`, whose extension is .svg or .png, and beside it the .dat and the .gp. There must
// be a sample.
PlotResult draw(const ProgressPlot& plot, const std::filesystem::path& image, PlotSize size = {});

// The text of the two files, for draw() and its tests.
std::string progress_plot_data(const ProgressPlot& plot);
std::string progress_plot_script(const ProgressPlot& plot, const std::filesystem::path& image,
                                 PlotSize size);

}  // namespace lockstep

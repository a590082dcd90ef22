// The box plots of a study: minimum, quartiles, maximum and mean of a measure for each value of a
// grid name. Makes the plots of a summary and draws them as SVG and PNG.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/plots/plot.h"
#include "study/table.h"

namespace lockstep::host {

struct BoxGroup {
  std::string label;                 // below it
  std::optional<SampleSummary> box;  // none: no run has a value
  ResultCounts results;              // of all its runs
};

struct BoxPlot {
  std::string stem;  // of its files: letters, digits, '_', '-' and '.' only
  std::string title, x_label, y_label;
  std::vector<BoxGroup> groups;  // from left to right
  ResultCounts results;          // of all runs behind it
};

// One plot for each node, measure and combination of values of the other axes; the values of the
// last axis, with those that vary together with it, are along x, in the order of the rows. Stems
// are unique.
std::vector<BoxPlot> box_plots(const std::vector<GridAxis>& grid, std::span<const SummaryRow> rows);

// Writes <stem>.dat, .gp, .svg and .png to `directory`, which must exist.
PlotResult draw(const BoxPlot& plot, const std::filesystem::path& directory, PlotSize size = {});

// The text of the two files, for draw() and its tests.
std::string box_plot_data(const BoxPlot& plot);
std::string box_plot_script(const BoxPlot& plot, PlotSize size);

}  // namespace lockstep::host

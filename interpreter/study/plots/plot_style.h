// Common to all plots: the size of letters for a picture, and text that fits its width.
#pragma once

#include <string>
#include <string_view>

#include "study/plots/plot.h"

namespace lockstep::host {

// How many lines progress_plot.gp can distinguish: six colors, solid or with one of five patterns
// of dashes.
constexpr std::size_t kPlotStyles = 36;

// The height of a letter, in pixels: smaller in a small picture, down to what can be read.
constexpr int kLeastLetter = 8;
int letter_height(PlotSize size);
// About how many letters of a height fit into a width.
std::size_t letters_in(double pixels, int height);

// Without its beginning when it is longer than `most` columns: "…/left/arm".
std::string shortened(std::string_view text, std::size_t most);

// A gnuplot expression: the title in one or two lines. A longer title loses its beginning.
std::string plot_title(std::string_view text, PlotSize size);

}  // namespace lockstep::host

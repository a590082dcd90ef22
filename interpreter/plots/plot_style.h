// What all plots have in common: lines that can be told apart, letters that fit the size of the
// picture, and text that fits its width.
#pragma once

#include <string>
#include <string_view>

#include "plots/plot.h"

namespace lockstep {

// So many lines differ: six colors that the color-blind and gray paper keep apart (Okabe and Ito),
// first solid, then with five patterns of dashes.
constexpr std::size_t kPlotStyles = 36;

// In gnuplot's words, again and again: "rgb '#0072b2'", "dt solid" and "fs solid".
std::string plot_color(std::size_t index);
std::string plot_dash(std::size_t index);
std::string plot_fill(std::size_t index);

// The height of a letter, in pixels: smaller in a small picture, down to what can be read.
constexpr int kLeastLetter = 8;
int letter_height(PlotSize size);
// How many letters of a height fit into a width, more or less.
std::size_t letters_in(double pixels, int height);

// Without its beginning when it is longer than `most` columns: "…/left/arm".
std::string shortened(std::string_view text, std::size_t most);

// An expression of gnuplot: the title in one line or two. What is longer loses its beginning.
std::string plot_title(std::string_view text, PlotSize size);

}  // namespace lockstep

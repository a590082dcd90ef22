// Runs gnuplot as a child process, without a shell, and quotes text for it. Used by the plots of
// this folder.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/plots/plot.h"

namespace lockstep::host {

// A string literal of gnuplot for exactly this text; control characters are made visible as
// printable() does.
std::string gnuplot_string(std::string_view text);

// The same for a file in the script's directory, whatever its name: gnuplot would execute a name
// that begins with '<' or '|'.
std::string gnuplot_file(std::string_view name);

// The lines that choose the output format by the extension of `image`: .svg or .png.
std::string gnuplot_terminal(const std::filesystem::path& image, PlotSize size);
bool is_plot_image(const std::filesystem::path& image);

// The letters, digits, '_', '-' and '.' of `text`; other characters in a row become one '_'.
std::string file_stem(std::string_view text);

struct PlotFiles {
  std::filesystem::path directory;
  std::string stem;  // of the .dat and the .gp
  std::string data, script;
  std::vector<std::string> images;  // file names that the script draws
};

// Writes the data and the script and runs gnuplot, all in a temporary directory beside the output.
// Finished files are moved from there; the rest is removed.
PlotResult draw(const PlotFiles& files);

}  // namespace lockstep::host

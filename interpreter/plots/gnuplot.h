// Runs gnuplot as a child process, without a shell, and writes text so that gnuplot takes it as
// text. Used by the plots of this folder.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "plots/plot.h"

namespace lockstep {

// A string literal of gnuplot that stands for exactly this text; control characters are made
// visible as printable() does.
std::string gnuplot_string(std::string_view text);

// The same for a file in the script's directory, whatever its name: a name of gnuplot's that begins
// with '<' or '|' would be a command.
std::string gnuplot_file(std::string_view name);

// The lines that choose what is drawn on, by the extension of `image`: .svg or .png.
std::string gnuplot_terminal(const std::filesystem::path& image, PlotSize size);
bool is_plot_image(const std::filesystem::path& image);

// Letters, digits, '_', '-' and '.' of `text`; what lies between as one '_'.
std::string file_stem(std::string_view text);

struct PlotFiles {
  std::filesystem::path directory;
  std::string stem;  // of the .dat and the .gp
  std::string data, script;
  std::vector<std::string> images;  // file names that the script draws
};

// Writes the data and the script and has gnuplot run the script, all in a temporary directory
// beside. What is finished is moved from there; of what is not, nothing stays.
PlotResult draw(const PlotFiles& files);

}  // namespace lockstep

// The files of a plot: <stem>.dat with the numbers, <stem>.gp that draws them, and the images. A
// researcher can change the first two and run gnuplot again. They are written even without gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lockstep::host {

struct PlotResult {
  std::vector<std::filesystem::path> files;  // written, the images last
  std::string error;                         // "", or what went wrong: for people
  bool gnuplot_missing = false;              // then `error` says what to install

  bool ok() const { return error.empty(); }
};

struct PlotSize {
  int width = 720, height = 432;  // pixels of the SVG; a PNG has twice as many each way
  static constexpr int kLeastWidth = 360, kLeastHeight = 240;  // smaller is unreadable
  static constexpr int kMost = 8000;
};

}  // namespace lockstep::host

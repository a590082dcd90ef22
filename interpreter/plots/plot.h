// What a plot leaves on disk: <stem>.dat with the numbers, <stem>.gp that draws them, so that a
// researcher can change either and run gnuplot again, and the images. Without gnuplot the first two
// are there all the same.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lockstep {

struct PlotResult {
  std::vector<std::filesystem::path> files;  // written, the images last
  std::string error;                         // "", or what went wrong: for people
  bool gnuplot_missing = false;              // then `error` says what to install

  bool ok() const { return error.empty(); }
};

struct PlotSize {
  int width = 720, height = 432;  // pixels of the SVG; a PNG has twice as many each way
  static constexpr int kLeastWidth = 360, kLeastHeight = 240;  // below, nobody can read it
  static constexpr int kMost = 8000;
};

}  // namespace lockstep

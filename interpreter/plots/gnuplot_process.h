// Runs gnuplot on a script, as a child process without a shell, and waits for it. The child has
// limits and does not outlive us, however we end. gnuplot.h decides what it draws.
#pragma once

#include <filesystem>
#include <string>

namespace lockstep {

struct GnuplotEnd {
  int reason = 0;        // why it could not be started, or 0
  bool ok = false;       // it ended with 0
  bool stopped = false;  // we ended it: a stop signal came
  std::string said = {};
};

// `script` is the name of a file in `directory`, in which gnuplot runs. gnuplot is the first in an
// absolute directory of PATH. A program with more rights than its user takes /usr/bin/gnuplot.
GnuplotEnd run_gnuplot(const std::filesystem::path& directory, const std::string& script);

}  // namespace lockstep

// Runs gnuplot on a script, as a child process without a shell, and waits for it. What it draws is
// gnuplot.h's matter.
#pragma once

#include <filesystem>
#include <string>

namespace lockstep {

struct GnuplotEnd {
  int reason = 0;   // why it could not be started, or 0
  bool ok = false;  // it ended with 0
  std::string said = {};
};

// `script` is the name of a file in `directory`, in which gnuplot runs.
GnuplotEnd run_gnuplot(const std::filesystem::path& directory, const std::string& script);

}  // namespace lockstep

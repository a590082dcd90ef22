// Runs gnuplot on a script, as a child process without a shell, and waits for it. The child has
// resource limits and does not outlive this process. gnuplot.h decides what it draws.
#pragma once

#include <filesystem>
#include <string>

namespace lockstep::host {

struct GnuplotEnd {
  int reason = 0;        // why it could not be started, or 0
  bool ok = false;       // it ended with 0
  bool stopped = false;  // a stop signal came, and we ended it
  std::string said = {};
};

// `script` is the name of a file in `directory`, in which gnuplot runs. Uses the first gnuplot in
// an absolute directory of PATH, or /usr/bin/gnuplot if the program has more rights than its user.
GnuplotEnd run_gnuplot(const std::filesystem::path& directory, const std::string& script);

}  // namespace lockstep::host

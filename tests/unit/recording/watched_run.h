// Runs a tree of scripted leaves under observers, on virtual time, as the loop would.
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/terminal/outlet.h"
#include "run/observers.h"
#include "support/scripted_run.h"

namespace lockstep::host::test {

struct WatchedRun {
  WatchedRun(std::string_view tree, std::string_view leaves) : run(tree, leaves) {}
  WatchedRun(Tree tree, std::string_view leaves) : run(std::move(tree), leaves) {}

  // Ticks until the root completes or a leaf faults, or the run has `max_ticks` ticks.
  RunEnd watch(std::initializer_list<Observer*> who, std::uint64_t max_ticks = 1000);

  ScriptedRun run;
  // What the observers are told of, besides what the leaves do.
  std::map<std::uint64_t, std::vector<Fault>> faults;  // by tick
  WorstTick worst;
  RunStart start{.period = std::chrono::milliseconds(100), .real_time = false};
};

// The lines of a run that comes to `ticks`, without its closing line. Behind a cut, it begins with
// tick `first`, and its leaves start again.
std::string recorded_lines(std::string_view tree, std::string_view leaves, std::uint64_t first,
                           std::uint64_t ticks);

// What was said to a temporary file.
class TextFile {
 public:
  TextFile() : file_(std::tmpfile()) {}
  ~TextFile() { std::fclose(file_); }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  Outlet& outlet() { return outlet_; }
  std::string text();

 private:
  std::FILE* file_;
  Outlet outlet_{fileno(file_)};
};

// A path in the temporary folder, removed with everything in it.
class TemporaryPath {
 public:
  TemporaryPath();
  ~TemporaryPath();
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;

  const std::string& path() const { return path_; }
  std::string text() const;

 private:
  std::string folder_, path_;
};

}  // namespace lockstep::host::test

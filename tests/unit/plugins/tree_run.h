// Runs of one tree with the leaves of a shipped plugin, on a virtual clock: what the tests of
// plugins/r1sim and plugins/fetch are made of.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "language/document/project.h"
#include "run/loading/plugin_set.h"
#include "run/run.h"
#include "tree/catalog.h"

namespace lockstep::host::test {

struct TreeRunOptions {
  std::uint64_t seed = 0;
  double rate = 100;   // Hz
  double limit = 300;  // seconds; a run that takes longer stays Running
  std::function<void(Ticker&)> after_tick = {};
};

struct TreeRunEnd {
  Status status = Status::Running;
  double seconds = 0;  // ticks times period
  std::string fault;   // "" = none
  std::vector<std::string> log;
};

class TreeRunner {
 public:
  // `nodes` stands inside <BehaviorTree>. Throws std::invalid_argument with what is wrong.
  TreeRunner(const std::string& plugin, const std::string& nodes);

  TreeRunEnd run(const TreeRunOptions& options = {}) const;
  // By its name in the tree.
  NodeIndex node(const std::string& name) const;

 private:
  PluginSet plugins_;
  std::unique_ptr<Project> project_;
  Catalog catalog_;
  Tree tree_;
};

}  // namespace lockstep::host::test

// The command line options of `lockstep test`.
#pragma once

#include <string>
#include <vector>

#include "cli/tools/test/coverage_files.h"
#include "run/loading/plugins.h"

namespace lockstep::host {

struct TestCommandOptions {
  std::vector<std::string> paths;
  std::vector<std::string> filters;
  unsigned jobs = 0;
  std::string out = "failed-scenarios";
  std::string junit;
  bool json = false;
  bool list = false;
  bool updates = false;
  bool watches = false;
  bool mutates = false;
  CoverageOptions coverage;
  PluginOptions plugins;
};

void define_test_options(CLI::App& app, TestCommandOptions& options);

}  // namespace lockstep::host

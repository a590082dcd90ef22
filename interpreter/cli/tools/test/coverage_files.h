// The options of `lockstep test` about coverage, and what they write.
#pragma once

#include <optional>
#include <string>

#include "scenario/coverage.h"

namespace CLI {
class App;
}

namespace lockstep::host {

struct CoverageOptions {
  bool table = false;
  std::string page, lcov;       // files; "": none
  std::optional<double> least;  // percent

  bool is_wanted() const { return table || !page.empty() || !lcov.empty() || least; }
};

void define_coverage_options(CLI::App& app, CoverageOptions& options);

// Returns the exit code. `is_quiet`: nothing goes to stdout.
int write_coverage(const CoverageOptions& options, Coverage& coverage, unsigned jobs,
                   bool is_quiet);

}  // namespace lockstep::host

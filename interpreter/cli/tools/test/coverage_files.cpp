#include "cli/tools/test/coverage_files.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "base/system/output_file.h"
#include "cli/checks.h"
#include "cli/console.h"
#include "cli/exit_code.h"

namespace lockstep::host {
namespace {

bool write_coverage_file(std::string_view option, const std::string& path,
                         const std::string& text) {
  const auto done = write_output(path, text);
  if (!done) print_error(fmt::format("{}: {}", option, printable(done.error().message)));
  return done.has_value();
}

}  // namespace

void define_coverage_options(CLI::App& app, CoverageOptions& options) {
  app.add_flag("--coverage", options.table,
               "Print the coverage: which of the possible results and halts of each node the "
               "scenarios show");
  app.add_option("--coverage-html", options.page, "Write the coverage as an HTML page")
      ->type_name("FILE");
  app.add_option("--lcov", options.lcov,
                 "Write the coverage in the format of lcov: lines of XML, and branches")
      ->type_name("FILE");
  app.add_option("--fail-under", options.least,
                 "Exit with code 1 if the coverage is less than P percent")
      ->type_name("P")
      ->check(number_between(0.0, 100.0));
}

int write_coverage(const CoverageOptions& options, Coverage& coverage, unsigned jobs,
                   bool is_quiet) {
  const auto trees = coverage.trees(jobs);
  int code = kExitSuccess;
  if (options.table && !is_quiet) code = write_results(to_table(trees));
  if (!options.page.empty() &&
      !write_coverage_file("--coverage-html", options.page, to_page(trees))) {
    return kExitUsage;
  }
  if (!options.lcov.empty() && !write_coverage_file("--lcov", options.lcov, to_lcov(trees))) {
    return kExitUsage;
  }
  if (!options.least || percent(trees) >= *options.least) return code;
  print_error(fmt::format("coverage is {:.1f} %, less than {} %", percent(trees), *options.least),
              "--coverage shows what is missing");
  return first_failure(code, kExitFailure);
}

}  // namespace lockstep::host

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
               "Print what the scenarios show of each node, of what is possible");
  app.add_option("--coverage-html", options.page, "Write it as a page")->type_name("FILE");
  app.add_option("--lcov", options.lcov, "Write it as lcov does: lines of XML, and branches")
      ->type_name("FILE");
  app.add_option("--fail-under", options.least,
                 "Exit with code 1 if less than this share is shown, in percent")
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

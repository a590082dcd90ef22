#include "cli/tools/test/test_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <thread>

#include "cli/checks.h"
#include "cli/load/load_options.h"

namespace lockstep::host {

void define_test_options(CLI::App& app, TestCommandOptions& options) {
  options.paths = {"."};
  options.jobs = std::max(1u, std::thread::hardware_concurrency());
  app.add_option("paths", options.paths,
                 "Files of scenarios, or folders: all NAME.test.xml in them and below, and trees "
                 "with scenarios in them (default: this folder)")
      ->type_name("FILE|DIR");
  app.add_option("--filter", options.filters,
                 "Only scenarios whose name contains this text, or matches a pattern with *; may "
                 "be repeated")
      ->type_name("TEXT")
      ->allow_extra_args(false);
  app.add_flag("--list", options.list, "List the scenarios without playing them");
  app.add_option("-j,--jobs", options.jobs, "Threads; the result does not depend on it")
      ->type_name("J")
      ->transform(whole_number(1, 4096));
  app.add_option("--out", options.out, "The directory for the recordings of failures")
      ->type_name("DIR")
      ->capture_default_str();
  app.add_option("--junit", options.junit, "Write the results to a file in the format of JUnit")
      ->type_name("FILE");
  app.add_flag("--update", options.updates,
               "Write again the recordings that runs are compared with (same-as)");
  app.add_flag("--watch", options.watches,
               "Play them again whenever a file of these folders changes, until Ctrl-C");
  app.add_flag("--mutate", options.mutates,
               "Then test the scenarios: make small changes in the trees and report those that no "
               "scenario notices");
  define_coverage_options(app, options.coverage);
  app.add_flag("--json", options.json, "Print the results as JSON");
  add_plugin_options(app, options.plugins);
  add_program_option(app, options.plugins);
}

}  // namespace lockstep::host

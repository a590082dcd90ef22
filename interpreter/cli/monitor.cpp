#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>

#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "core/diagnostics.h"
#include "terminal/text_table.h"
#include "web/browser.h"
#include "web/registry.h"

namespace lockstep {
namespace {

struct MonitorCommandOptions {
  bool opens = false;
  std::optional<std::uint64_t> process;
};

int list(const std::vector<RegisteredRun>& runs) {
  std::vector<TableRow> rows;
  for (const RegisteredRun& run : runs) {
    rows.push_back({std::to_string(run.process), printable(run.link), printable(run.tree_file)});
  }
  return write_results(text_table(rows, 3));
}

int open_one(const std::vector<RegisteredRun>& runs) {
  if (runs.size() != 1) {
    print_error("several runs have a monitor", "lockstep monitor --open PID");
    return kExitUsage;
  }
  if (open_in_browser(runs[0].link)) return kExitSuccess;
  print_error("there is no xdg-open", "open " + runs[0].link);
  return kExitUsage;
}

int monitor(const MonitorCommandOptions& options) {
  auto runs = registered_runs();
  if (options.process) {
    std::erase_if(runs, [&](const RegisteredRun& run) {
      return static_cast<std::uint64_t>(run.process) != *options.process;
    });
  }
  if (runs.empty()) {
    print_error(options.process ? fmt::format("no run {} of yours has a monitor", *options.process)
                                : "no run of yours has a monitor",
                "lockstep run TREE.xml --monitor");
    return kExitUsage;
  }
  return options.opens ? open_one(runs) : list(runs);
}

std::function<int()> define_monitor(CLI::App& app) {
  const auto options = std::make_shared<MonitorCommandOptions>();
  app.add_flag("--open", options->opens, "Open the page of the run in the browser");
  app.add_option("pid", options->process, "Only this run: the number of its process")
      ->type_name("PID")
      ->transform(whole_number(1));
  return [options] { return monitor(*options); };
}

}  // namespace

const Command kMonitorCommand{
    "monitor", "List your runs that have a monitor, or open the page of one",
    "A row for each run of `lockstep run --monitor`: the number of its process, the link of its\n"
    "page, its tree.\n"
    "Exit code: 0 there is one, 2 usage, or there is none.\n"
    "\n"
    "Examples:\n"
    "  lockstep monitor\n"
    "  lockstep monitor --open\n"
    "  lockstep monitor --open 4711",
    define_monitor};

}  // namespace lockstep

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>

#include "base/core/diagnostics.h"
#include "base/core/value.h"
#include "base/terminal/text_table.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "show/web/attach_socket.h"
#include "show/web/browser.h"
#include "show/web/registry.h"
#include "show/web/server_socket.h"

namespace lockstep::host {
namespace {

struct MonitorCommandOptions {
  bool opens = false, attaches = false;
  std::string run;  // the number of its process, or the path of its socket; "": any
  std::string address = std::string(kAnyLoopback);
};

int refuse(const std::string& message, const std::string& hint) {
  print_error(message, hint);
  return kExitUsage;
}

int list(const std::vector<RegisteredRun>& runs) {
  std::vector<TableRow> rows;
  for (const RegisteredRun& run : runs) {
    const std::string link = run.link.empty() ? "none yet: --attach" : run.link;
    rows.push_back({std::to_string(run.process), printable(link), printable(run.tree_file)});
  }
  return write_results(text_table(rows, 3));
}

// The link of a run, which gets a monitor if it has none.
Result<std::string> link_of(const RegisteredRun& run, const MonitorCommandOptions& options) {
  return run.link.empty() ? attach(run.socket, options.address) : run.link;
}

int reach(const RegisteredRun& run, const MonitorCommandOptions& options) {
  const auto link = link_of(run, options);
  if (!link) return refuse(link.error().message, link.error().hint);
  if (options.attaches) {
    if (const int code = write_results(*link + "\n"); code != kExitSuccess) return code;
  }
  if (!options.opens || open_in_browser(*link)) return kExitSuccess;
  return refuse("there is no xdg-open", "open " + *link);
}

int monitor(const MonitorCommandOptions& options) {
  const bool reaches = options.opens || options.attaches;
  // One that is not listed, as that of another user, or of a run in a container.
  if (reaches && !options.run.empty() && !parse_int(options.run)) {
    return reach({.link = {}, .tree_file = {}, .socket = options.run}, options);
  }
  auto runs = registered_runs();
  std::erase_if(runs, [&](const RegisteredRun& run) {
    return !options.run.empty() && std::to_string(run.process) != options.run;
  });
  if (runs.empty()) {
    const std::string none = options.run.empty() ? "no run of yours has a monitor"
                                                 : fmt::format("no run {} of yours has a monitor",
                                                               printable(options.run));
    return refuse(none, "lockstep run TREE.xml --monitor, or --monitor-socket PATH");
  }
  if (!reaches) return list(runs);
  if (runs.size() > 1) {
    return refuse("several runs have a monitor",
                  fmt::format("lockstep monitor --{} PID", options.opens ? "open" : "attach"));
  }
  return reach(runs.front(), options);
}

std::function<int()> define_monitor(CLI::App& app) {
  const auto options = std::make_shared<MonitorCommandOptions>();
  app.add_flag("--open", options->opens, "Open the page of the run in the browser");
  app.add_flag(
      "--attach", options->attaches,
      "Print the link of the run; one that has only a socket (run --monitor-socket) gets a "
      "monitor");
  app.add_option("--at", options->address,
                 "The address of that monitor; an existing monitor keeps its address")
      ->type_name("ADDRESS:PORT")
      ->capture_default_str();
  app.add_option("run", options->run,
                 "Only this run: the number of its process, or the path of its socket")
      ->type_name("PID|PATH");
  return [options] { return monitor(*options); };
}

}  // namespace

extern const Command kMonitorCommand{
    "monitor", "List your runs that have a monitor, open the page of one, or attach a monitor",
    "A row for each run of `lockstep run --monitor` or --monitor-socket: the number of its "
    "process,\n"
    "the link of its page, its tree.\n"
    "Exit code: 0 a run was found, 2 usage, or no run was found.\n"
    "\n"
    "Examples:\n"
    "  lockstep monitor\n"
    "  lockstep monitor --open\n"
    "  lockstep monitor --open 4711\n"
    "  lockstep run tree.xml --monitor-socket /tmp/robot.sock &\n"
    "  lockstep monitor --attach /tmp/robot.sock",
    define_monitor};

}  // namespace lockstep::host

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/loading.h"
#include "engine/compile.h"
#include "observers/recorder.h"
#include "observers/statistics.h"
#include "runtime/loop.h"
#include "runtime/stop_signals.h"

namespace lockstep {
namespace {

struct Options {
  LoadOptions load;
  std::string tree;
  double rate = 100;
  std::string clock = "wall";
  std::uint64_t seed = 0;
  std::optional<std::uint64_t> max_ticks;
  std::optional<double> timeout;
  double stall = 5;
  std::string record;
  std::string view = "auto";
  bool json = false;
};

int exit_code_of(const RunEnd& end) {
  switch (end.reason) {
    case StopReason::Completed:
      return end.status == Status::Success ? kExitSuccess : kExitFailure;
    case StopReason::Fault:
      return kExitLeafFault;
    case StopReason::Timeout:
    case StopReason::MaxTicks:
      return kExitLimit;
    case StopReason::Signal:
      return kExitSignal + end.signal;
  }
  return kExitLeafFault;
}

int run(const Options& options) {
  Loaded loaded;
  Diagnostics diagnostics;
  const int code = load(options.tree, options.load, loaded, diagnostics);
  print_diagnostics(diagnostics, Severity::Warning, stderr);
  if (!loaded.definition) return code;
  Diagnostics refused;
  if (!loaded.plugins->initialize(refused)) {
    print_diagnostics(refused, Severity::Warning, stderr);
    return kExitPluginRefused;
  }
  const Tree tree = compile(*loaded.definition);
  StopSignals::install();
  RunOptions run_options{.seed = options.seed, .period = deadline_of(1, options.rate)};
  Run it(tree, run_options);
  Statistics statistics(tree);
  std::vector<Observer*> observers{&statistics};
  WallClock wall;
  VirtualClock virtual_clock;
  Clock& clock = options.clock == "wall" ? static_cast<Clock&>(wall) : virtual_clock;
  LoopOptions loop{.rate = options.rate,
                   .max_ticks = options.max_ticks,
                   .timeout = std::nullopt,
                   .stop_signal = StopSignals::received};
  if (options.timeout) loop.timeout = from_seconds(*options.timeout);
  const RunEnd end = run_loop(it, clock, loop, observers);
  write_text(statistics.summary(), stdout, wants_color(stdout));
  return exit_code_of(end);
}

std::function<int()> define(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("tree", options->tree, "Tree file")->type_name("TREE.xml")->required();
  app.add_option("--rate", options->rate, "Ticks per second")
      ->type_name("HZ")
      ->check(CLI::Range(0.001, 100000.0))
      ->capture_default_str();
  app.add_option("--clock", options->clock, "wall, or virtual: as fast as the machine allows")
      ->check(CLI::IsMember({"wall", "virtual"}))
      ->capture_default_str();
  app.add_option("--max-ticks", options->max_ticks, "Stop after N ticks")->type_name("N");
  app.add_option("--seed", options->seed, "Seed")->type_name("N")->capture_default_str();
  add_load_options(app, options->load);
  return [options] { return run(*options); };
}

}  // namespace

const Command kRunCommand{"run", "Run a tree", "Example:\n  lockstep run trees/door_pulling.xml",
                          define};

}  // namespace lockstep

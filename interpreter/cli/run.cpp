#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/loading.h"
#include "cli/view.h"
#include "engine/compile.h"
#include "observers/recorder.h"
#include "observers/stall_observer.h"
#include "observers/statistics.h"
#include "observers/waiting.h"
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
    case StopReason::Overrun:
      return kExitOverrun;
  }
  return kExitLeafFault;
}

// Whose fault it was, for a person who has to find the culprit.
std::string describe(const Fault& fault, const Tree& tree, const RunEnd& end) {
  const NodeType& type = *tree.labels[fault.node].type;
  const std::string when =
      end.ticks == 0 ? "before the first tick"
                     : fmt::format("in tick {} at {:.3f} s", end.ticks - 1, to_seconds(end.time));
  return fmt::format("the leaf '{}' ({} of plugin '{}') failed {}: {}", tree.path(fault.node),
                     type.id, type.plugin, when, fault.message);
}

class RunCommand {
 public:
  RunCommand(const Options& options, const Loaded& loaded, const Tree& tree)
      : options_(options), tree_(tree), view_(options.view, tree), statistics_(tree) {
    if (!options.record.empty()) recorder_.emplace(tree, recorder_options(loaded));
    if (options.stall > 0) {
      stall_.emplace(tree, from_seconds(options.stall), [this](const Standstill& standstill) {
        view_.print("warning: " + standstill_text(tree_, standstill));
      });
    }
  }

  int run() {
    if (recorder_ && !recorder_->error().empty()) {
      print_error(recorder_->error());
      return kExitUsage;
    }
    StopSignals::install(View::last_words);
    WallClock wall_clock;
    VirtualClock virtual_clock;
    const bool is_wall = options_.clock == "wall";
    RunEnd end;
    std::optional<Fault> fault;
    {
      Run run(tree_, {options_.seed, deadline_of(1, options_.rate), view_.leaf_log()});
      end = run_loop(run, is_wall ? static_cast<Clock&>(wall_clock) : virtual_clock, loop_options(),
                     observers());
      if (run.fault() != nullptr) fault = *run.fault();
    }
    view_.close();
    if (fault) print_error(describe(*fault, tree_, end));
    print_summary();
    return exit_code_of(end);
  }

 private:
  RecorderOptions recorder_options(const Loaded& loaded) {
    RecorderOptions recorder{.path = options_.record,
                             .tree_file = options_.tree,
                             .rate_hz = options_.rate,
                             .seed = options_.seed};
    for (const DeclaredArgument& argument : loaded.project->arguments) {
      recorder.arguments[argument.name] = argument.value;
    }
    recorder.on_error = [this](const std::string& error) { view_.print("error: " + error); };
    return recorder;
  }

  LoopOptions loop_options() const {
    LoopOptions loop{.rate = options_.rate,
                     .max_ticks = options_.max_ticks,
                     .timeout = std::nullopt,
                     .stop_signal = StopSignals::received};
    if (options_.timeout) loop.timeout = from_seconds(*options_.timeout);
    return loop;
  }

  std::span<Observer* const> observers() {
    observers_ = {&statistics_};
    if (recorder_) observers_.push_back(&*recorder_);
    if (stall_) observers_.push_back(&*stall_);
    if (view_.observer() != nullptr) observers_.push_back(view_.observer());
    return observers_;
  }

  void print_summary() {
    Summary summary = statistics_.summary();
    if (recorder_ && !recorder_->error().empty()) summary.notes.push_back(recorder_->error());
    if (options_.json) {
      fmt::print("{}\n", to_json(summary));
    } else {
      write_text(summary, stdout, wants_color(stdout));
    }
    flush_stdout();
  }

  const Options& options_;
  const Tree& tree_;
  View view_;
  Statistics statistics_;
  std::optional<Recorder> recorder_;
  std::optional<StallObserver> stall_;
  std::vector<Observer*> observers_;
};

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
  return RunCommand(options, loaded, tree).run();
}

// CLI11 reads -1 as the largest number there is.
std::string check_count(const std::string& text) {
  const bool good = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  return good ? "" : fmt::format("'{}' is not a whole number from 0", text);
}

void define_loop_options(CLI::App& app, Options& options) {
  app.add_option("--rate", options.rate, "Ticks per second")
      ->type_name("HZ")
      ->check(CLI::Range(0.001, 100000.0))
      ->capture_default_str();
  app.add_option("--clock", options.clock,
                 "wall, or virtual: the same run, as fast as the machine allows")
      ->check(CLI::IsMember({"wall", "virtual"}))
      ->capture_default_str();
  app.add_option("--seed", options.seed,
                 "Of the leaves' random numbers: the same seed gives the same numbers")
      ->type_name("N")
      ->check(check_count)
      ->capture_default_str();
  app.add_option("--max-ticks", options.max_ticks, "Stop after N ticks, at least 1")
      ->type_name("N")
      ->check(check_count)
      ->check([](const std::string& text) {
        return text == "0" ? std::string("a run has at least 1 tick") : std::string();
      });
  app.add_option("--timeout", options.timeout, "Stop after S seconds of the run's clock")
      ->type_name("S")
      ->check(CLI::Range(0.0, 1e9));
  app.add_option("--stall", options.stall,
                 "Report a child that stands still for S seconds while others wait for it; 0 = "
                 "never")
      ->type_name("S")
      ->check(CLI::Range(0.0, 1e9))
      ->capture_default_str();
}

std::function<int()> define(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("tree", options->tree, "Tree file")->type_name("TREE.xml")->required();
  define_loop_options(app, *options);
  app.add_option("--record", options->record,
                 "Write a recording (JSON Lines; see docs/recording.md)")
      ->type_name("FILE.jsonl");
  app.add_option("--view", options->view,
                 "On stderr while it runs: live (a terminal), plain lines, none; auto = live on a "
                 "terminal, else plain")
      ->check(CLI::IsMember({"auto", "live", "plain", "none"}))
      ->capture_default_str();
  app.add_flag("--json", options->json, "Print the summary as JSON");
  add_load_options(app, options->load);
  return [options] { return run(*options); };
}

}  // namespace

const Command kRunCommand{
    "run", "Run a tree at a fixed rate until it completes",
    "The summary goes to stdout, everything else to stderr.\n"
    "Exit code: 0 Success, 1 Failure, 2 usage, 3 invalid tree, 4 plugin refused, 5 leaf fault,\n"
    "124 --timeout or --max-ticks, 130 SIGINT, 143 SIGTERM (running leaves are halted in order; a\n"
    "second signal ends the program at once).\n"
    "\n"
    "Examples:\n"
    "  lockstep run trees/door_pulling.xml\n"
    "  lockstep run trees/door_pulling.xml --arg barriers=0.5 --rate 50 --record run.jsonl\n"
    "  lockstep run trees/door_pulling.xml --clock virtual --seed 7 --json",
    define};

}  // namespace lockstep

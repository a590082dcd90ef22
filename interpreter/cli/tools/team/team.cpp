#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "base/core/wording.h"
#include "base/json/json.h"
#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/tools/team/robot_files.h"
#include "judge/summary/property_observer.h"
#include "judge/summary/statistics.h"
#include "record/write/recorder.h"
#include "run/loop.h"
#include "run/shape_of.h"
#include "run/stop_signals.h"
#include "team/simulated_network.h"
#include "team/team_run.h"

namespace lockstep::host {
namespace {

constexpr double kUsualRate = 100;

struct TeamOptions {
  LoadCommandOptions load;
  std::vector<std::string> robots;  // FILE[,ARGUMENT=VALUE...]
  std::string leaves;               // a leaf model; "": those of plugins
  std::optional<double> rate;       // nothing: that of the leaf model, or kUsualRate
  std::uint64_t seed = 0;
  std::optional<double> timeout;
  std::optional<std::uint64_t> max_ticks;
  double latency = 0, jitter = 0, loss = 0;
  std::vector<std::string> cuts;    // FROM..UNTIL, in seconds
  std::vector<double> starts = {};  // of each robot, in seconds
  std::string record;               // a folder; "": nothing is recorded
  bool json = false;
};

std::optional<NetworkOptions> network_options(const TeamOptions& options) {
  NetworkOptions network{.latency = from_seconds(options.latency),
                         .jitter = from_seconds(options.jitter),
                         .loss = options.loss,
                         .cuts = {},
                         .seed = options.seed};
  for (const std::string& text : options.cuts) {
    const auto dots = text.find("..");
    const auto from = parse_double(text.substr(0, dots));
    const auto until =
        dots == std::string::npos ? std::nullopt : parse_double(text.substr(dots + 2));
    if (!from || !until || !(*from >= 0 && *from < *until && *until <= 1e6)) {
      print_error(fmt::format("--cut {}: not a time", printable(text)),
                  "FROM..UNTIL in seconds, such as 2..4.5");
      return std::nullopt;
    }
    network.cuts.push_back({from_seconds(*from), from_seconds(*until)});
  }
  return network;
}

// One of them, until its end.
class Robot {
 public:
  explicit Robot(RobotOfTeam& robot, bool uses_model) : robot_(robot) {
    if (uses_model) robot.played.set_models(robot.runnable.tree, robot.models);
  }

  const std::string& name() const { return robot_.label; }
  PluginSet& plugins() const { return *robot_.runnable.plugins; }

  void connect(SimulatedNetwork& network, Turns& turns, std::size_t number,
               const TeamOptions& options) {
    clock_.emplace(turns, number);
    const std::uint64_t run = options.seed << 8u | (number + 1);  // of another seed, another one
    team_.emplace(robot_.runnable.tree, robot_.teams, run, network.join(robot_.teams, *clock_),
                  *clock_);
    const Shape shape = shape_of(robot_.runnable.tree);
    statistics_.emplace(shape);
    properties_.emplace(robot_.runnable.properties, [](const Property&, const std::string&) {});
    if (options.record.empty()) return;
    RecorderOptions recorder;
    recorder.path = options.record + '/' + name() + ".jsonl";
    recorder.run = {.tree_file = robot_.file, .rate_hz = *options.rate, .seed = options.seed};
    recorder.run.arguments = values_of(robot_.runnable.arguments);
    recorder.run.values = robot_.runnable.values;
    recorder.run.run = TeamRun::short_run(run);
    recorder_.emplace(shape, std::move(recorder));
  }

  void run(Turns& turns, std::size_t number, const TeamOptions& options) {
    const double start = number < options.starts.size() ? options.starts[number] : 0;
    turns.enter(number, from_seconds(start));
    {
      team_->use_here();
      Run run(robot_.runnable.tree,
              {.seed = options.seed + number, .rate = *options.rate, .virtual_time = true});
      LoopOptions loop;
      loop.rate = *options.rate;
      loop.max_ticks = options.max_ticks.value_or(kMostVirtualTicks);
      loop.stop_signal = StopSignals::received;
      if (options.timeout) loop.timeout = from_seconds(*options.timeout);
      std::vector<Observer*> observers{&*team_, &*statistics_, &*properties_};
      if (recorder_) observers.push_back(&*recorder_);
      run_loop(run, *clock_, loop, observers);
    }
    turns.leave(number);
  }

  // Why it has not succeeded, where that is known.
  std::string why() const {
    const Summary summary = this->summary();
    if (!summary.fault.empty()) return summary.fault;
    return summary.result == RunResult::Stopped ? team_->why() : std::string();
  }
  Summary summary() const {
    Summary summary = statistics_->summary();
    properties_->add_to(summary);
    return summary;
  }
  std::string recording_error() const { return recorder_ ? recorder_->error() : ""; }

 private:
  RobotOfTeam& robot_;
  std::optional<TurnClock> clock_;
  std::optional<TeamRun> team_;
  std::optional<Statistics> statistics_;
  std::optional<PropertyObserver> properties_;
  std::optional<Recorder> recorder_;
};

std::string text_of(const std::vector<std::unique_ptr<Robot>>& robots,
                    const SimulatedNetwork& network) {
  std::string text;
  std::size_t width = 0;
  for (const auto& it : robots) width = std::max(width, it->name().size());
  for (const auto& it : robots) {
    const Summary summary = it->summary();
    text += fmt::format("{:<{}}  {}, {}, {:.3f} s{}\n", it->name(), width,
                        to_string(summary.result), counted(summary.ticks, "tick"), summary.seconds,
                        it->why().empty() ? "" : ": " + printable(it->why()));
    for (const PropertySummary& property : summary.properties)
      text += fmt::format("{:<{}}  property {}\n", "", width, to_text(property, false));
  }
  text += fmt::format("largest spread {:.4g}\n", network.largest_spread());
  return text;
}

std::string json_of(const std::vector<std::unique_ptr<Robot>>& robots,
                    const SimulatedNetwork& network) {
  Json json = Json::object();
  json["largest_spread"] = network.largest_spread();
  Json all = Json::object();
  for (const auto& it : robots) {
    Json robot = Json::object();
    const Summary summary = it->summary();
    robot["result"] = std::string(to_string(summary.result));
    robot["ticks"] = summary.ticks;
    robot["seconds"] = summary.seconds;
    if (!it->why().empty()) robot["why"] = it->why();
    if (!summary.properties.empty()) robot["properties"] = json_of(summary.properties);
    all[it->name()] = std::move(robot);
  }
  json["robots"] = std::move(all);
  return json.printable(2) + '\n';
}

int simulate(TeamOptions options) {
  keep_stdout_for_results();
  const auto network_of = network_options(options);
  if (!network_of) return kExitUsage;
  TeamOfRobots team;
  const int wrong = team.load({.load = options.load,
                               .robots = options.robots,
                               .leaves = options.leaves,
                               .rate = options.rate,
                               .usual_rate = kUsualRate});
  if (wrong != kExitSuccess) return wrong;
  options.rate = team.rate();
  std::vector<std::unique_ptr<Robot>> robots;
  for (RobotOfTeam& it : team.robots())
    robots.push_back(std::make_unique<Robot>(it, !options.leaves.empty()));
  if (!options.starts.empty() && options.starts.size() != robots.size()) {
    print_error("--start: a time for each robot, in their order");
    return kExitUsage;
  }
  if (!options.record.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.record, error);  // what is wrong, the recorder says
  }
  StopSignals::install();
  SimulatedNetwork network(*network_of);
  Turns turns(robots.size());
  for (std::size_t i = 0; i < robots.size(); ++i) {
    Diagnostics refused;
    if (!robots[i]->plugins().initialize(refused)) {
      print_diagnostics(refused, Severity::Warning);
      return kExitPluginRefused;
    }
    robots[i]->connect(network, turns, i, options);
    if (const std::string error = robots[i]->recording_error(); !error.empty()) {
      print_error(error);
      return kExitUsage;
    }
  }
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < robots.size(); ++i)
    threads.emplace_back([&, i] { robots[i]->run(turns, i, options); });
  for (std::thread& it : threads) it.join();
  const int failed =
      write_results(options.json ? json_of(robots, network) : text_of(robots, network));
  int lost = kExitSuccess;
  for (const auto& it : robots) {
    if (it->recording_error().empty()) continue;
    print_error(it->recording_error());
    lost = kExitRecording;
  }
  if (const int signal = StopSignals::received(); signal != 0) return kExitSignal + signal;
  const bool all_succeed = std::ranges::all_of(
      robots, [](const auto& it) { return it->summary().result == RunResult::Success; });
  return first_failure(failed, all_succeed ? lost : kExitFailure);
}

std::function<int()> define_team(CLI::App& app) {
  const auto options = std::make_shared<TeamOptions>();
  app.add_option("robots", options->robots,
                 "The tree file of each robot, with its arguments: carry.xml,me=left")
      ->required()
      ->type_name("FILE[,ARG=VALUE]");
  app.add_option("--leaves", options->leaves,
                 "A leaf model: the leaves of all robots do what it allows, by chance")
      ->type_name("FILE");
  app.add_option("--rate", options->rate,
                 "Ticks per second, of each (default: that of the leaf model, otherwise 100)")
      ->check(number_between(0.001, 100000));
  app.add_option("--seed", options->seed, "Of the random numbers of the network and the leaves")
      ->transform(whole_number())
      ->capture_default_str();
  app.add_option("--timeout", options->timeout, "End after so many seconds")
      ->check(number_between(1e-9, 1e9));
  app.add_option("--max-ticks", options->max_ticks, "End after so many ticks of a robot")
      ->transform(whole_number(1));
  app.add_option("--latency", options->latency, "Seconds that each word takes")
      ->check(number_between(0, 1e6))
      ->capture_default_str();
  app.add_option("--jitter", options->jitter, "Up to so many seconds more, by chance")
      ->check(number_between(0, 1e6))
      ->capture_default_str();
  app.add_option("--loss", options->loss, "The fraction of words that are lost, by chance")
      ->check(number_between(0, 1))
      ->capture_default_str();
  app.add_option("--cut", options->cuts,
                 "FROM..UNTIL in seconds: nothing arrives. May be repeated");
  app.add_option("--start", options->starts, "Seconds at which each robot starts, in their order")
      ->check(number_between(0, 1e6));
  app.add_option("--record", options->record, "Record each run into this folder, as NAME.jsonl");
  app.add_flag("--json", options->json, "Print the results as JSON");
  add_load_options(app, options->load);
  add_mock_options(app, options->load);
  add_program_option(app, options->load.plugins);
  return [options] { return simulate(*options); };
}

}  // namespace

extern const Command kTeamCommand{
    "team", "Simulate robots that are in step, with a network that is late or cut",
    "All robots are in this process, on one virtual clock: the same seed gives the same runs.\n"
    "Exit code: 0 all succeed, 1 one fails or does not end, 3 invalid tree, 4 plugin\n"
    "refused, 8 all succeed, but a recording could not be written, 2 usage.\n"
    "\n"
    "Examples:\n"
    "  lockstep team carry.xml,me=left carry.xml,me=right\n"
    "  lockstep team left.xml right.xml --latency 0.02 --jitter 0.005 --loss 0.01 --cut 2..4",
    define_team};

}  // namespace lockstep::host

// Leaves that break the contract while they run: the run ends with the reason, the leaf is told
// what a leaf that ends is told, and nothing unwinds through the engine. All of it also when the
// plugin is isolated, with the same words.
#include <catch2/catch.hpp>

#include "abi/support/plugins.h"
#include "run/run.h"

namespace lockstep::host::test {
namespace {

using Strings = std::vector<std::string>;

struct Outcome {
  Strings calls;      // what the leaf was told (it logs that)
  std::string fault;  // "" = none
  bool completed = false;

  friend bool operator==(const Outcome&, const Outcome&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Outcome& it) {
    for (const std::string& call : it.calls) out << call << ' ';
    return out << '[' << it.fault << ']' << (it.completed ? " completed" : "");
  }
};

LeafLog log_into(Strings& calls) {
  return [&calls](std::string_view who, lockstep_log_level, std::string_view message) {
    CHECK(who == "Test/probe");
    calls.emplace_back(message);
  };
}

// Runs the plugin's leaf, asking for its progress after each tick; then halts and destroys it.
Outcome run_once(const std::string& plugin, int max_ticks, Isolation isolation) {
  PluginSet plugins;
  set_isolation(plugins, isolation);
  Diagnostics diagnostics;
  REQUIRE(plugins.load_file(plugin_path(plugin), diagnostics));
  REQUIRE(plugins.initialize(diagnostics));
  const Tree tree = tree_of(*plugins.types().at(0), 2);
  Outcome outcome;
  {
    RunOptions options;
    options.log = log_into(outcome.calls);
    Run run(tree, options);
    for (int tick = 0; tick < max_ticks && run.fault() == nullptr; ++tick) {
      outcome.completed = is_complete(run.tick(tick * run.period()));
      run.ticker().progress(0);
    }
    run.halt();
    if (run.fault() != nullptr) outcome.fault = run.fault()->message;
  }
  return outcome;
}

Outcome run(const std::string& plugin, int max_ticks = 2) {
  const Outcome in_process = run_once(plugin, max_ticks, Isolation::InProcess);
  INFO(plugin);
  CHECK(run_once(plugin, max_ticks, Isolation::Isolated) == in_process);
  return in_process;
}

TEST_CASE("a leaf that keeps the contract runs, whatever the minor it was built for") {
  const Outcome expected{{"create", "start", "tick", "tick", "destroy"}, "", true};
  CHECK(run("good") == expected);
  CHECK(run("newer_minor_same_size") == expected);
  CHECK(run("newer_minor") == expected);
}

TEST_CASE("a leaf that was compiled with the header of 1.0 runs") {
  CHECK(run("probe_1_0", 2) == Outcome{{}, "", true});
  CHECK(run("probe_1_0", 1) == Outcome{{"halt"}, "", false});
}

TEST_CASE("a leaf that breaks the contract in a tick is a fault, and is halted") {
  const Strings halted = {"create", "start", "halt", "destroy"};
  CHECK(run("needs_children") == Outcome{halted, "ticks a child, but has none"});
  CHECK(run("status_out_of_range") ==
        Outcome{halted, "returned status 7, expected one of lockstep/leaf.h"});
  CHECK(run("error_in_tick") == Outcome{halted, "lost the arm"});
  CHECK(run("throws_int") == Outcome{halted, "threw an exception that is not a std::exception"});
  CHECK(run("throws_exception") == Outcome{halted, "threw an exception: out of reach"});
  CHECK(run("condition_running") == Outcome{{"create", "start", "tick", "halt", "destroy"},
                                            "is a condition and returned running"});
}

TEST_CASE("a progress that is not a number is a fault") {
  CHECK(run("nan_progress") == Outcome{{"create", "start", "tick", "halt", "destroy"},
                                       "reported a progress that is not a number"});
}

TEST_CASE("a leaf that fails in start is neither ticked nor halted") {
  CHECK(run("error_in_start") == Outcome{{"create", "destroy"}, "no power"});
}

TEST_CASE("an error in halt is a fault") {
  CHECK(run("error_in_halt", 1) == Outcome{{"create", "start", "tick", "destroy"}, "stuck brake"});
}

TEST_CASE("a leaf that cannot be created is a fault") {
  const std::string reason = "could not be created: ";
  CHECK(run("error_in_create") == Outcome{{"create", "destroy"}, reason + "unknown error"});
  CHECK(run("null_from_create") ==
        Outcome{{}, reason + "its create returned NULL without an error"});
  CHECK(run("throws_in_create") ==
        Outcome{{}, reason + "threw an exception that is not a std::exception"});
  CHECK(run("error_in_create_run") ==
        Outcome{{}, "the run context of plugin 'error_in_create_run' " + reason + "no world"});
}

TEST_CASE("an exception from destroy is a line in the log") {
  CHECK(run("throws_in_destroy") ==
        Outcome{{"create", "start", "tick", "tick", "destroy",
                 "its destroy threw an exception that is not a std::exception"},
                "",
                true});
}

}  // namespace
}  // namespace lockstep::host::test

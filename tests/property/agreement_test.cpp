// The engine against the reference interpreter, tick by tick, on random trees.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/synchronized.h"
#include "property/coverage.h"
#include "property/random_tree.h"
#include "property/reference.h"
#include "support/scripted_run.h"

namespace lockstep::test {
namespace {

constexpr int kTrees = 10000;

std::string to_text(const EventLog& events) {
  std::string text;
  for (const Event& event : events)
    text += fmt::format(" {} {},", to_string(event.call), event.leaf);
  return text;
}

// Runs a trial in both interpreters; collects the first difference.
class Comparison {
 public:
  explicit Comparison(const Trial& trial)
      : trial_(trial),
        engine_(tree_text(trial.plan), leaves_text(trial.plan)),
        reference_(trial.plan) {}

  // "" when they agree.
  std::string run(Coverage* coverage) {
    for (tick_ = 0; tick_ < trial_.ticks && difference_.empty(); ++tick_) {
      compare_tick();
      if (coverage != nullptr) coverage->count(engine_);
      if (trial_.halt_every != 0 && tick_ % trial_.halt_every == trial_.halt_every - 1) halt();
      if (reference_.fault()) break;
    }
    return difference_;
  }

 private:
  template <class Value>
  void same(std::string_view what, const Value& engine, const Value& reference) {
    if (engine == reference || !difference_.empty()) return;
    difference_ =
        fmt::format("tick {}: {}: engine {}, reference {}", tick_, what, engine, reference);
  }
  void same_progress(std::string_view what, std::size_t node, double engine, double reference) {
    if (std::abs(engine - reference) < 1e-12) return;
    if (std::isnan(engine) && std::isnan(reference)) return;
    same(fmt::format("{} of node {}", what, node), engine, reference);
  }

  void compare_tick() {
    engine_.events.clear();
    reference_.events.clear();
    const Nanoseconds now = tick_ * from_seconds(trial_.period);
    const Status status = engine_.tick(now);
    const Status expected = reference_.tick(now);
    compare_fault();
    same("root", to_string(status), to_string(expected));
    compare_nodes();
    compare_events();
    if (trial_.watched && !reference_.fault()) compare_progress();
  }

  void compare_fault() {
    const Fault* fault = engine_.ticker().fault();
    same("leaf at fault", fault != nullptr ? static_cast<int>(fault->node) : -1,
         reference_.fault() ? static_cast<int>(*reference_.fault()) : -1);
  }

  void compare_events() {
    if (engine_.events != reference_.events) {
      same("calls", to_text(engine_.events), to_text(reference_.events));
    }
  }

  void compare_nodes() {
    Ticker& ticker = engine_.ticker();
    for (NodeIndex node = 0; node < engine_.tree().nodes.size(); ++node) {
      if (ticker.status(node) != reference_.status(node)) {
        same(fmt::format("status of node {}", node), to_string(ticker.status(node)),
             to_string(reference_.status(node)));
      }
      if (ticker.held(node) != reference_.held(node)) {
        same(fmt::format("held node {}", node), ticker.held(node), reference_.held(node));
      }
      if (reference_.fault()) continue;
      if (ticker.ticked(node) != reference_.ticked(node)) {
        same(fmt::format("ticked node {}", node), ticker.ticked(node), reference_.ticked(node));
      }
      if (reference_.ticked(node)) compare_snapshot(node);
    }
  }

  void compare_snapshot(NodeIndex node) {
    const auto& expected = reference_.snapshot(node);
    if (expected.empty()) return;
    const auto got = child_progress(engine_.ticker(), node);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      same_progress(fmt::format("snapshot {}", i), node, got[i], expected[i]);
    }
  }

  // What an observer would ask. It may meet a fault, and then the run ends.
  void compare_progress() {
    for (NodeIndex node = 0; node < engine_.tree().nodes.size(); ++node) {
      const double engine = engine_.ticker().progress(node);
      const double reference = reference_.progress(node);
      compare_fault();
      if (reference_.fault()) return halt();
      same_progress("progress", node, engine, reference);
    }
  }

  void halt() {
    engine_.events.clear();
    reference_.events.clear();
    engine_.ticker().halt_all();
    reference_.halt();
    compare_fault();
    compare_nodes();
    compare_events();
  }

  const Trial& trial_;
  ScriptedRun engine_;
  Reference reference_;
  int tick_ = 0;
  std::string difference_;
};

std::string difference(const Trial& trial) {
  return Comparison(trial).run(nullptr);
}

// The smallest trial that still fails, by taking away what it can do without.
Trial shrunk(Trial trial) {
  for (bool smaller = true; smaller;) {
    smaller = false;
    for (Trial& candidate : smaller_trials(trial)) {
      if (difference(candidate).empty()) continue;
      trial = std::move(candidate);
      smaller = true;
      break;
    }
  }
  return trial;
}

void report(std::uint64_t seed, const Trial& failing) {
  const Trial trial = shrunk(failing);
  FAIL_CHECK("seed " << seed << ", period " << trial.period << ", halted every " << trial.halt_every
                     << ", watched " << trial.watched << "\n  tree:   " << tree_text(trial.plan)
                     << "\n  leaves: " << leaves_text(trial.plan) << "\n  " << difference(trial));
}

// All that a run does, tick by tick, as one value.
struct Trace {
  std::vector<Status> statuses;
  std::vector<EventLog> events;
  RunState state;

  friend bool operator==(const Trace&, const Trace&) = default;
};

Trace trace(ScriptedRun& run, const Trial& trial) {
  Trace trace{{}, {}, run.ticker().run_state()};
  for (int tick = 0; tick < trial.ticks && run.ticker().fault() == nullptr; ++tick) {
    trace.statuses.push_back(run.tick(tick * from_seconds(trial.period)));
    trace.events.push_back(run.events);
  }
  trace.state = run.ticker().run_state();
  return trace;
}

}  // namespace

TEST_CASE("the engine agrees with the reference interpreter on random trees") {
  Coverage coverage;
  int failures = 0;
  for (std::uint64_t seed = 0; seed < kTrees && failures < 3; ++seed) {
    const Trial trial = random_trial(seed);
    if (Comparison(trial).run(&coverage).empty()) continue;
    report(seed, trial);
    ++failures;
  }
  REQUIRE(failures == 0);
  coverage.check();
}

TEST_CASE("the same tree and seed give the same run") {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const Trial trial = random_trial(seed);
    ScriptedRun one(tree_text(trial.plan), leaves_text(trial.plan));
    ScriptedRun two(tree_text(trial.plan), leaves_text(trial.plan));
    const Trace first = trace(one, trial);
    INFO("seed " << seed << ": " << tree_text(trial.plan));
    REQUIRE(first == trace(two, trial));

    one.restart();
    REQUIRE(one.ticker().run_state() == RunState(one.tree()));
    REQUIRE(first == trace(one, trial));
  }
}

}  // namespace lockstep::test

// Measures on random trees keep their laws. That a recording has those of its run follows from
// producers_test.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "judge/measure/measure_spec.h"
#include "property/random_tree.h"
#include "property/reference.h"
#include "run/shape_of.h"
#include "study/run_measures.h"
#include "unit/recording/watched_run.h"

namespace lockstep::host::test {
namespace {

constexpr int kMeasureTrees = 1500;
constexpr double kWatchedRate = 10;  // of WatchedRun

// All measures of a tree with all their arguments, as far as it has such nodes.
std::vector<MeasureSpec> all_of(const Tree& tree) {
  const Shape measured = shape_of(tree);
  const std::vector<std::string> paths = paths_of(measured);
  std::vector<MeasureSpec> specs;
  const auto add = [&](const std::string& text) {
    const MeasureSpec spec = parse_measure(text).value();
    const bool fits = Measuring(measured, {&spec, 1}).error().empty();
    if (fits) specs.push_back(spec);
    return fits;
  };
  // A SyncProgress also goes by its child, which comes behind it: one of the two is enough.
  const auto add_held_by = [&](const std::string& path) {
    bool has_child = false;
    for (auto other = paths.rbegin(); other != paths.rend(); ++other) {
      const bool is_child = has_child && other[-1].starts_with(*other + '/');
      has_child = !is_child && add(fmt::format("held-by:{}:{}", path, *other));
    }
  };
  add("progress-distance[1:3]");
  for (const Measure* measure : all_measures()) {
    const std::string name(measure->name);
    if (measure->of == MeasureOf::Run || measure->of == MeasureOf::Parallel) add(name);
    const bool names_one = measure->of == MeasureOf::Child || measure->of == MeasureOf::User ||
                           measure->of == MeasureOf::Pool;
    for (const std::string& path : paths) {
      if (names_one) add(fmt::format("{}:{}", name, path));
    }
  }
  for (const std::string& path : paths) {
    add(fmt::format("predictability:{}@0.5", path));
    add_held_by(path);
  }
  return specs;
}

bool are_same(double one, double other) {
  return one == other || (std::isnan(one) && std::isnan(other));
}

// What was measured of a run, by the path of the node.
struct Measured {
  std::map<std::string, double> held, held_by;  // by all others
};

bool begins_at_zero(const Plan& plan) {
  return std::ranges::any_of(plan.beside, [](const Plan& group) {
    return !group.barriers.empty() && group.barriers.front() == 0;
  });
}

}  // namespace

TEST_CASE("what held a child by all others is what it was held") {
  std::map<std::string_view, int> above_zero;  // how often each measure was
  for (std::uint64_t seed = 0; seed < kMeasureTrees; ++seed) {
    const Trial trial = random_trial(seed);
    INFO("seed " << seed << ": " << tree_text(trial.plan) << ", " << leaves_text(trial.plan));
    WatchedRun run(tree_text(trial.plan), leaves_text(trial.plan));
    const auto specs = all_of(run.run.tree());
    RunMeasures of_run(shape_of(run.run.tree()), specs, kWatchedRate);
    REQUIRE(of_run.error() == "");
    run.watch({&of_run}, static_cast<std::uint64_t>(trial.ticks));
    Measured measured;
    for (std::size_t i = 0; i < of_run.columns().size(); ++i) {
      const StudyColumn& column = of_run.columns()[i];
      const double value = of_run.values()[i];
      if (column.is_gap) continue;
      above_zero[parse_measure(column.measure)->measure->name] += value > 0;
      if (column.measure.starts_with("held:")) measured.held[column.node] = value;
      if (column.measure.starts_with("held-by:")) measured.held_by[column.node] += value;
    }
    if (run.run.ticker().fault() != nullptr) continue;  // who was not ticked then was not held
    for (const auto& [node, sum] : measured.held_by) {
      INFO("held-by of " << node << ": " << sum << ", held " << measured.held.at(node));
      // Who begins again after a failure, at a barrier at 0, may wait for nobody else.
      CHECK((are_same(sum, measured.held.at(node)) || begins_at_zero(trial.plan)));
    }
  }
  for (const Measure* measure : all_measures()) {
    if (measure->of == MeasureOf::Entry || measure->name.starts_with("progress-distance-"))
      continue;
    if (measure->name == "factor" || measure->name == "speed-changes") continue;  // nobody paces
    INFO(measure->name);
    CHECK(above_zero[measure->name] > 100);
  }
}

namespace {

// The measures of a synchronized node once more, from what the reference has seen: samples that are
// taken before its children are ticked, without guards.
struct SlowMeasures {
  const Plan* plan = nullptr;
  std::size_t node = 0;
  std::vector<std::size_t> children = {};
  std::uint64_t samples = 0;
  double distance = 0, spread = 0;

  void after_tick(const Reference& reference) {
    const bool asked =
        std::ranges::any_of(children, [&](std::size_t child) { return reference.ticked(child); });
    if (!reference.ticked(node) || !asked) return;
    ++samples;
    const auto& snapshot = reference.snapshot(node);
    for (std::size_t i = 0; i < children.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (is_guard(plan->children[i]) || is_guard(plan->children[j])) continue;
        const double apart = std::abs(snapshot[i] - snapshot[j]);
        if (std::isnan(apart)) continue;
        distance += apart;
        spread = std::max(spread, apart);
      }
    }
  }
};

// In pre-order; gives the number of the next node.
std::size_t add_measures(const Plan& plan, std::size_t node, std::vector<SlowMeasures>& all) {
  SlowMeasures it{.plan = &plan, .node = node};
  std::size_t next = node + 1;
  std::vector<SlowMeasures> below;
  for (const Plan& child : plan.children) {
    it.children.push_back(next);
    next = add_measures(child, next, below);
  }
  if (plan.kind == "ParallelAbsolute" || plan.kind == "ParallelRelative") all.push_back(it);
  all.insert(all.end(), below.begin(), below.end());
  return next;
}

}  // namespace

TEST_CASE("the measures of random trees are those of the reference, without guards") {
  int guarded = 0, compared = 0;
  for (std::uint64_t seed = 0; seed < kMeasureTrees; ++seed) {
    const Trial trial = random_trial(seed);
    std::vector<SlowMeasures> slow;
    add_measures(trial.plan, 0, slow);
    if (slow.empty()) continue;
    INFO("seed " << seed << ": " << tree_text(trial.plan) << ", " << leaves_text(trial.plan));
    Reference reference(trial.plan);
    WatchedRun run(tree_text(trial.plan), leaves_text(trial.plan));
    const MeasureSpec specs[] = {parse_measure("progress-distance").value(),
                                 parse_measure("spread").value()};
    RunMeasures measured(shape_of(run.run.tree()), specs, kWatchedRate);
    run.watch({&measured}, static_cast<std::uint64_t>(trial.ticks));
    if (run.run.ticker().fault() != nullptr) continue;
    Status status = Status::Running;
    for (int tick = 0; tick < trial.ticks && !is_complete(status); ++tick) {
      status = reference.tick(tick * run.start.period);
      for (SlowMeasures& it : slow) it.after_tick(reference);
    }
    for (const SlowMeasures& it : slow) {
      const std::string path = run.run.tree().path(static_cast<NodeIndex>(it.node));
      for (std::size_t column = 0; column < measured.columns().size(); ++column) {
        if (measured.columns()[column].node != path) continue;
        const double value = measured.values()[column];
        INFO(measured.columns()[column].measure << " of " << path);
        if (it.samples == 0) {
          CHECK(std::isnan(value));
        } else {
          const bool is_spread = measured.columns()[column].measure == "spread";
          CHECK(value == Approx(is_spread ? it.spread : it.distance).margin(1e-9));
        }
        ++compared;
      }
      guarded += std::ranges::any_of(it.plan->children, is_guard) && it.distance > 0 ? 1 : 0;
    }
  }
  CHECK(guarded > 30);
  CHECK(compared > 300);
}

}  // namespace lockstep::host::test

// What pacing does not change: who is held, and what comes out, follow from progress alone.
#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>

#include "property/comparison.h"
#include "property/random_source.h"
#include "support/scripted_run.h"

namespace lockstep::host::test {
namespace {

constexpr std::uint64_t kPacedRuns = 2000;

// Times count as slowly as they are slowed, so they are not those of the same tree without pace.
// And what a leaf does without a tick is not played.
bool has_own_time(const Plan& plan) {
  if (plan.script.find('~') != std::string::npos) return true;
  const bool is_timed = plan.kind == "Wait" || plan.kind == "Timeout" || plan.kind == "Delay";
  return (is_timed && !plan.wall_clock) || std::ranges::any_of(plan.children, has_own_time);
}

void take_out_pace(Plan& plan) {
  plan.pace = false;
  for (Plan& child : plan.children) take_out_pace(child);
  for (Plan& group : plan.beside) take_out_pace(group);
}

// Trees in which much is slowed: nested parallels of motions, each with its own speed.
class Motions {
 public:
  explicit Motions(std::uint64_t seed) : random_(seed) {}

  Trial trial() {
    Trial trial{.plan = parallel(2)};
    trial.ticks = 60;
    trial.watched = false;
    return trial;
  }

 private:
  Plan parallel(int depth) {
    const bool is_relative = random_.one_in(2);
    Plan plan{.kind = is_relative ? "ParallelRelative" : "ParallelAbsolute", .pace = true};
    plan.reaction = random_.pick(std::array{0.0, 0.2, 1.0});
    plan.delta = random_.pick(std::array{.05, .1, .3});
    if (!is_relative) plan.barrier_count = random_.between(1, 5);
    for (int i = random_.between(2, 4); i > 0; --i) plan.children.push_back(child(depth));
    return plan;
  }
  Plan child(int depth) {
    if (depth > 0 && random_.one_in(4)) return parallel(depth - 1);
    if (!random_.one_in(4)) return motion();
    return {.kind = "Sequence", .children = {motion(), motion()}, .memory = true};
  }
  Plan motion() {
    const double step = random_.pick(std::array{.02, .05, .08, .13, .2});
    const double least = random_.pick(std::array{0.0, 0.0, 0.0, 0.3, 1.0});
    return {.kind = "action",
            .name = fmt::format("a{}", leaves_++),
            .script = fmt::format("+{}*{}", step, least)};
  }

  RandomSource random_;
  int leaves_ = 0;
};

struct Played {
  std::vector<std::vector<NodeState>> states;  // after each tick
  std::vector<std::string> scripts;            // of each leaf: what it did
  long slowed = 0;                             // ticks of leaves with a factor below 1
};

Played play(const Trial& trial, const std::string& leaves) {
  ScriptedRun run(tree_of(trial).tree.value(), leaves);
  Played played;
  const Tree& tree = run.tree();
  played.scripts.resize(tree.leaves.size());
  for (int tick = 0; tick < trial.ticks && run.ticker().fault() == nullptr; ++tick) {
    run.events.clear();
    run.tick(tick * from_seconds(trial.period));
    for (const Event& event : run.events) {
      played.slowed += event.call == Call::SetPace && event.factor < 1;
      if (event.call != Call::Tick) continue;
      const NodeIndex node = tree.leaves[event.leaf].node;
      const Status status = run.ticker().status(node);
      const auto letter = status_letters()[static_cast<std::size_t>(status)];
      played.scripts[event.leaf] += fmt::format("{}{}", letter, run.leaf(event.leaf).progress());
    }
    auto& states = played.states.emplace_back();
    for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
      states.push_back(run.ticker().node_state(node));
    }
  }
  return played;
}

}  // namespace

TEST_CASE("a run of nodes that pace is a run of the same nodes without pace") {
  long slowed = 0, compared = 0;
  for (std::uint64_t seed = 0; seed < kPacedRuns; ++seed) {
    Trial trial = seed % 2 == 0 ? Motions(seed).trial() : paced(random_trial(seed), seed);
    if (seed % 2 == 0) REQUIRE(difference(trial).empty());
    if (has_own_time(trial.plan) || !difference(trial).empty()) continue;
    const Played with = play(trial, leaves_text(trial.plan));
    if (with.states.size() != static_cast<std::size_t>(trial.ticks)) continue;  // a fault
    // A leaf that was ended in the tick in which it was ticked has no result to play.
    const auto cannot_be_played = [](const std::string& it) {
      return it.find_first_of("In") != std::string::npos;  // nor is "nan" a progress
    };
    if (std::ranges::any_of(with.scripts, cannot_be_played)) continue;
    ScriptedRun names(tree_of(trial).tree.value(), leaves_text(trial.plan));
    std::string leaves;
    for (std::uint32_t leaf = 0; leaf < with.scripts.size(); ++leaf) {
      const std::string& script = with.scripts[leaf];
      leaves += names.leaf_name(leaf) + "=" + (script.empty() ? "R" : script) + " ";
    }
    take_out_pace(trial.plan);
    INFO("seed " << seed << ": " << tree_text(trial.plan) << "\n" << leaves);
    REQUIRE(play(trial, leaves).states == with.states);
    slowed += with.slowed;
    ++compared;
  }
  CHECK(compared > 200);
  CHECK(slowed > 500);
}

}  // namespace lockstep::host::test

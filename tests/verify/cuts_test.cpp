// verify --cuts: the process may end in any state, and the next one goes on from there.
#include <algorithm>
#include <catch2/catch.hpp>

#include "verify/barrier_watch.h"
#include "verify/chance_runs.h"
#include "verify/verified.h"

namespace lockstep::host::test {
namespace {

Verified with_cuts(std::string_view tree, std::string_view rows, std::uint32_t cuts,
                   std::vector<std::string> properties = {}, const SearchLimits& limits = {}) {
  return Verified(tree, rows, limits, 10, std::move(properties), kLockstepRules, {.most = cuts});
}

// Of the findings, and what is said of the tree.
std::string said_of(const Verified& it) {
  std::string said = it.findings();
  for (const VerdictLine& line : it.verdict.facts) {
    if (line.name != "alike") said += '\n' + line.name + ": " + line.text;
  }
  return said;
}

constexpr auto kThreeTicks = R"(<leaf path="*" result="success" ticks="3"/>)";
// It ends in time, or never.
constexpr auto kInTime = "Fallback[memory=true](Timeout[seconds=.3](a) AlwaysRunning)";

}  // namespace

TEST_CASE("a cut leaf begins again, so it takes longer") {
  CHECK(with_cuts("a", kThreeTicks, 0).found.store.size() == 3);
  const Verified it = with_cuts("a", kThreeTicks, 1);
  CHECK(it.found.is_complete());
  CHECK(it.findings().empty());
  CHECK(it.said("results") == "success (from 3 ticks)");
  // With 0, 1 and 2 ticks of the leaf without a cut, and 1 and 2 of it after one.
  CHECK(it.found.store.size() == 5);
  const auto& assumed = it.verdict.assumed;
  CHECK(std::ranges::count(assumed,
                           "the process is cut at most 1 time in a run, and loses no tick") == 1);
}

TEST_CASE("what a leaf may do after a cut, as its row says") {
  const auto results = [](std::string_view says, std::string_view tree = "a") {
    const auto row =
        R"(<leaf path="*/a" result="success" ticks="3" on_resume=")" + std::string(says);
    return with_cuts(tree, row + "\"/>", 1).said("results");
  };
  CHECK(results("restart") == "success (from 3 ticks)");
  CHECK(results("failure") == "success (from 3 ticks), failure (from 2 ticks)");
  CHECK(results("restart;success") == "success (from 2 ticks)");
  // One that continues loses nothing: it is as without a cut, and nothing comes later.
  const std::vector<std::string> properties{"short: a.running at most 2 ticks"};
  const auto ticks = [&](std::string_view says) {
    const auto row = R"(<leaf path="*" result="success" ticks="3" on_resume=")" + std::string(says);
    return with_cuts("Sequence(a)", row + "\"/>", 3, properties).findings();
  };
  CHECK(ticks("continue").empty());
  CHECK(ticks("continue;restart") == "property/short");
}

TEST_CASE("a leaf that was held at the cut has its result when it gets a tick") {
  // b comes to the barrier in its third tick, and only then a gets one.
  constexpr auto kTree = "ParallelAbsolute[barriers=.5](a b)";
  const auto failures = [](std::string_view of_a) {
    const Verified it =
        with_cuts(kTree,
                  R"(<leaf path="*" result="success" finish="full" progress="grid:4" step="1"/>
           <leaf path="*/a" step="3" on_resume=")" +
                      std::string(of_a) + "\"/>",
                  1);
    CHECK(it.findings().empty());
    return it.said("results");
  };
  CHECK(failures("continue") == "success (from 4 ticks)");
  CHECK(failures("failure") == "success (from 4 ticks), failure (from 2 ticks)");
}

TEST_CASE("what a leaf may do after a cut, where no row says it") {
  Verified it = with_cuts("Sequence(a b c)", kThreeTicks, 1);
  const auto may = [&](std::size_t leaf) { return it.models.leaves[leaf].after_cut; };
  CHECK(may(0) == std::vector{AfterCut::StartsAgain});
  const auto allow = [&](const ProcessCuts& cuts) {
    for (LeafModel& leaf : it.models.leaves) leaf.after_cut.clear();
    allow_cuts(cuts, it.tree, it.models);
  };
  it.tree.leaves[0].at_cut = {.otherwise = AfterCut::Failure, .is_given = true};
  NodeType keeps_state = *it.tree.leaves[2].type;
  keeps_state.can_be_restored = true;
  it.tree.leaves[2].type = &keeps_state;
  allow({.most = 1, .otherwise = AfterCut::Success});
  CHECK(may(0) == std::vector{AfterCut::Failure});
  CHECK(may(1) == std::vector{AfterCut::Success});
  CHECK(may(2) == std::vector{AfterCut::StartsAgain, AfterCut::Continues, AfterCut::Failure,
                              AfterCut::Success});
  // Without a cut, leaves that differ in nothing else are equal.
  allow({.most = 0});
  CHECK(may(2).empty());
}

TEST_CASE("a tree in which no leaf runs is the same after a cut") {
  const Verified it = with_cuts("Wait[seconds=1]", "", 3);
  CHECK(it.found.store.size() == with_cuts("Wait[seconds=1]", "", 0).found.store.size());
  CHECK(it.findings().empty());
}

TEST_CASE("a resume from which the run cannot end is a finding with its cut") {
  CHECK(with_cuts(kInTime, kThreeTicks, 0).findings() ==
        "never-ticked/Test/Fallback/AlwaysRunning");
  const Verified it = with_cuts(kInTime, kThreeTicks, 1);
  CHECK(it.said("can always end") == "yes");
  CHECK(it.findings() == "trap-after-cut");
  REQUIRE(it.finding("trap-after-cut") != nullptr);
  const Finding& trap = *it.finding("trap-after-cut");
  INFO(trap.message);
  CHECK(trap.message.find(" and a cut it can no longer end") != std::string::npos);
  REQUIRE(trap.cuts.size() == 1);
  CHECK(std::ranges::count(trap.more, "before tick " + std::to_string(trap.cuts[0]) +
                                          ", cut: the process ends here and is resumed; "
                                          "'Test/Fallback/Timeout/a' starts again") == 1);
  CHECK(it.script("trap-after-cut").find("@cut " + std::to_string(trap.cuts[0])) == 0);
}

TEST_CASE("a trap without a cut stays one, though a cut leads out of it") {
  // Each holds what the other waits for, until one of them begins again.
  constexpr auto kTree =
      "Parallel(SyncProgress[barrier=coarse](SyncProgress[barrier=fine](a)) "
      "SyncProgress[barrier=coarse](Sequence[memory=true](b SyncProgress[barrier=fine](c)))) "
      "barrier[name=coarse barriers=.5] barrier[name=fine barriers=.25]";
  constexpr auto kRows = R"(<leaf path="*" finish="full" result="success"/>)";
  CHECK(with_cuts(kTree, kRows, 0).findings() == "trap");
  const Verified it = with_cuts(kTree, kRows, 1);
  CHECK(it.findings().starts_with("trap"));
  REQUIRE(it.finding("trap") != nullptr);
  CHECK(it.finding("trap")->cuts.empty());
}

TEST_CASE("a property that two cuts violate") {
  const std::vector<std::string> properties{"long: a.running at most 5 ticks"};
  constexpr auto kLong = R"(<leaf path="*" result="success" ticks="3"/>)";
  CHECK(with_cuts("Sequence(a)", kLong, 1, properties).findings().empty());
  const Verified it = with_cuts("Sequence(a)", kLong, 2, properties);
  CHECK(it.findings() == "property/long");
  REQUIRE(it.finding("property/long") != nullptr);
  CHECK(it.finding("property/long")->cuts.size() == 2);
}

TEST_CASE("no barrier is passed early because of a cut") {
  for (const auto* const tree :
       {"ParallelAbsolute[barriers=.25;.75](a b c)",
        "ParallelAbsolute[barriers=.5 at_barrier=tick](a Sequence[memory=true](b c))",
        "ParallelAbsolute[barriers=.5](a ParallelAbsolute[barriers=.5](b c))",
        "Parallel(SyncProgress[barrier=g](a) Sequence[memory=true](b SyncProgress[barrier=g](c))) "
        "barrier[name=g barriers=.5;1]"}) {
    INFO(tree);
    const Verified it = with_cuts(tree, R"(<leaf path="*" finish="full" result="success"/>)", 2);
    CHECK(it.found.is_complete());
    CHECK(it.findings().empty());
    CHECK_FALSE(find_contradiction(it.tree, it.models, {}, 10, it.found, {.runs = 200}));
  }
}

TEST_CASE(
    "a verdict with cuts is the same without symmetry, without rows of ticks and with threads") {
  constexpr auto kTree = "ParallelAbsolute[barriers=.5](a b c)";
  constexpr auto kRows = R"(<leaf path="*" step="0..1"/>)";
  const Verified it = with_cuts(kTree, kRows, 2);
  CHECK(said_of(it) == said_of(with_cuts(kTree, kRows, 2, {}, {.symmetry = false})));
  const Verified threads = with_cuts(kTree, kRows, 2, {}, {.jobs = 3});
  CHECK(threads.found.store.size() == it.found.store.size());
  CHECK(said_of(threads) == said_of(it));
  CHECK(said_of(it) ==
        said_of(with_cuts(kTree, kRows, 2, {}, {.few_root_ticks = 0, .few_ticks = 0})));
  CHECK(said_of(it) == said_of(with_cuts(kTree, kRows, 2, {}, {.hash_bits = 64})));
}

namespace {

// Leaves go on, as far as they may.
class LastAnswers final : public Answers {
  std::uint32_t choose(std::uint32_t count, std::uint32_t) override { return count - 1; }
};

}  // namespace

TEST_CASE("who watches barriers sees that one is passed early") {
  const Verified of("ParallelAbsolute[barriers=.5](a b)",
                    R"(<leaf path="*" finish="full" result="success"/>)");
  Blackboard board(of.tree);
  LastAnswers answers;
  ModelLeaves leaves(of.tree, of.models, board, answers);
  Ticker ticker(of.tree, leaves.slots(), board);
  BarrierWatch watch(of.tree, leaves);
  leaves.begin_tick();
  REQUIRE(ticker.tick_root(Nanoseconds(0)) == Status::Running);
  const auto equal = leaves.states();
  auto apart = equal;
  apart[0].level = 1;
  apart[1].level = 0;
  const auto look = [&](const std::vector<LeafState>& seen, const std::vector<LeafState>& ticked) {
    SavedRun saved;
    ticker.save(saved);
    leaves.restore(seen, {});
    watch.before_tick(ticker);
    leaves.restore(ticked, {});
    leaves.begin_tick();
    ticker.tick_root(Nanoseconds(1));
    watch.after_tick(ticker);
    ticker.restore(saved);
    return watch.passed();
  };
  CHECK_FALSE(look(equal, equal));
  CHECK_FALSE(look(apart, apart));  // the engine holds the one that is ahead
  const auto passed = look(apart, equal);
  REQUIRE(passed);
  CHECK(passed->child == 1);
  CHECK(passed->late == 2);
  CHECK(passed->barrier == 0.5);
}

}  // namespace lockstep::host::test

// The law of pacing: who is asked to be how fast, tick by tick at 10 Hz.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <map>
#include <sstream>

#include "engine/synchronized.h"
#include "support/scripted_run.h"

namespace lockstep::host::test {
namespace {

// Before each tick, for each leaf: its progress, then what it was told last, "-" while it is held.
struct PaceTrace {
  std::string_view name, tree, leaves, expected;
  std::size_t ticks;  // until the root succeeds
};

// clang-format off
constexpr PaceTrace kPaceTraces[] = {
  {"P1: with a delta, the faster child goes on at the pace of the slower one",
   "ParallelRelative[delta=.2 pace=true reaction=0](a b)", "a+.1 b+.3*0",
   "0/1 0/1  .1/1 .3/.01  .2/1 .303/.162  .3/1 .352/.247  .4/1 .426/.290  .5/1 .513/.312  "
   ".6/1 .606/.312  .7/1 .700/.333  .8/1 .800/.333  .9/1 .900/.333", 10},
  {"P2: between barriers, both arrive together",
   "ParallelAbsolute[barriers=.5;1 pace=true reaction=0](a b)", "a+.1 b+.25*0",
   "0/1 0/1  .1/1 .25/.25  .2/1 .313/.25  .3/1 .375/.25  .4/1 .438/.25  .5/1 .5/.4  .6/1 .6/.4  "
   ".7/1 .7/.4  .8/1 .8/.4  .9/1 .9/.4", 10},
  {"P2b: with a reaction, what counts falls slowly, and the faster one aims beyond the barrier",
   "ParallelAbsolute[barriers=.5 pace=true reaction=.5](a b)", "a+.04 b+.08*0",
   "0/1 0/1  .04/1 .08/.470  .08/1 .118/.575  .12/1 .164/.543  .16/1 .207/.543  .2/1 .250/.501  "
   ".24/1 .290/.501  .28/1 .331/.501  .32/1 .371/.467  .36/1 .408/.467  .4/1 .445/.467  "
   ".44/1 .483/.443  .48/1 .518/-  .52/1 .518/1  .56/1 .598/1  .6/1 .678/1  .64/1 .758/1  "
   ".68/1 .838/1  .72/1 .918/1  .76/1 .998/1  .8/1 1/1  .84/1 1/1  .88/1 1/1  .92/1 1/1  .96/1 1/1", 25},
  {"P3: a member of a barrier gets the larger of two factors",
   "Parallel(ParallelAbsolute[barriers=.5 pace=true reaction=0](SyncProgress[barrier=B](c1) c2) "
   "SyncProgress[barrier=B](d)) barrier[name=B barriers=.5 pace=true reaction=0]",
   "c1+.1*0 c2+.05*0 d+.125*0",
   "0/1 0/1 0/1  .1/1 .05/1 .125/.75  .2/1 .1/1 .219/.75  .3/1 .15/1 .313/.75  .4/1 .2/1 .406/.75  "
   ".5/- .25/1 .5/1  .5/- .3/1 .625/1  .5/- .35/1 .75/1  .5/- .4/1 .875/1  .5/- .45/1 1/1  "
   ".5/1 .5/1 1/1  .6/1 .55/1 1/1  .7/1 .6/1 1/1  .8/1 .65/1 1/1  .9/1 .7/1 1/1  1/1 .75/1 1/1  "
   "1/1 .8/1 1/1  1/1 .85/1 1/1  1/1 .9/1 1/1  1/1 .95/1 1/1", 20},
};
// clang-format on

std::string shown(double number) {
  std::string text = fmt::format("{:.3f}", number);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

std::vector<double> numbers_of(std::string_view text) {
  std::vector<double> numbers;
  std::istringstream in{std::string(text)};
  for (std::string pair; in >> pair;) {
    const auto slash = pair.find('/');
    numbers.push_back(std::stod(pair.substr(0, slash)));
    const std::string factor = pair.substr(slash + 1);
    numbers.push_back(factor == "-" ? -1 : std::stod(factor));
  }
  return numbers;
}

// What is told last is 1 in an activation in which nothing was told.
class Paces {
 public:
  explicit Paces(ScriptedRun& run) : run_(run), seen_(run.tree().leaves.size()) {}
  double told(std::size_t leaf) {
    const auto& all = run_.leaf(leaf).told_paces();
    if (all.size() > seen_[leaf]) last_[leaf] = all.back();
    seen_[leaf] = all.size();
    return last_.contains(leaf) ? last_[leaf] : 1;
  }

 private:
  ScriptedRun& run_;
  std::vector<std::size_t> seen_;
  std::map<std::size_t, double> last_;
};

TEST_CASE("pacing: worked traces") {
  for (const PaceTrace& trace : kPaceTraces) {
    INFO(trace.name);
    ScriptedRun run(trace.tree, trace.leaves);
    Paces paces(run);
    std::vector<double> seen;
    std::string text;
    Status status = Status::Running;
    std::size_t ticks = 0;
    for (; status == Status::Running && ticks < 100; ++ticks) {
      std::vector<double> before;
      for (const LeafNode& leaf : run.tree().leaves)
        before.push_back(run.ticker().progress(leaf.node));
      status = run.tick(ticks * std::chrono::milliseconds(100));
      for (std::size_t leaf = 0; leaf < before.size(); ++leaf) {
        const bool is_held = run.ticker().held(run.tree().leaves[leaf].node);
        const double told = paces.told(leaf);
        seen.push_back(before[leaf]);
        seen.push_back(is_held ? -1 : told);
        text += shown(before[leaf]) + "/" + (is_held ? "-" : shown(told)) + " ";
      }
      text += " ";
    }
    INFO(text);
    CHECK(status == Status::Success);
    CHECK(ticks == trace.ticks);
    const std::vector<double> expected = numbers_of(trace.expected);
    REQUIRE(seen.size() == expected.size());
    for (std::size_t i = 0; i < seen.size(); ++i)
      CHECK(seen[i] == Approx(expected[i]).margin(0.00051));
  }
}

// All that a leaf is told in so many ticks, at 10 Hz: "start tick set_pace=.25 tick".
std::string told(std::string_view tree, std::string_view leaves, std::uint32_t leaf, int ticks) {
  ScriptedRun run(tree, leaves);
  std::string text;
  for (int tick = 0; tick < ticks; ++tick) {
    run.events.clear();
    run.tick(tick * std::chrono::milliseconds(100));
    for (const Event& event : run.events) {
      if (event.leaf != leaf) continue;
      text += text.empty() ? "" : " ";
      text += to_string(event.call);
      if (event.call == Call::SetPace) text += "=" + shown(event.factor);
    }
    text += "|";
  }
  return text;
}

struct PaceRow {
  std::string_view law, tree, leaves;
  std::uint32_t leaf;
  std::string_view told;  // tick by tick
};

// clang-format off
constexpr PaceRow kPaceRows[] = {
  {"a leaf is told before its tick, once for each change, and not at its start",
   "ParallelAbsolute[barriers=1 pace=true reaction=0](a b)", "a+.1 b+.2*0", 1,
   "start tick| set_pace=0.444 tick| tick| tick|"},
  {"a leaf that begins while its branch is slow is told before its first tick",
   "ParallelAbsolute[barriers=1 pace=true reaction=0](a Sequence[memory=true](b c))",
   "a+.1 b+.5*0 c+.1*0", 2, "|||start set_pace=0.333 tick|"},
  {"a held leaf is not told, and after its pause only once it goes on",
   "ParallelAbsolute[barriers=.2;1 pace=true reaction=0](a b)", "a+.1 b+.3*0", 1,
   "start tick| pause| resume set_pace=0.292 tick| tick|"},
  {"a leaf that takes up more than it was told is believed",
   "ParallelAbsolute[barriers=1 pace=true reaction=0](a b)", "a+.1 b+.2*.6", 1,
   "start tick| set_pace=0.444 tick| tick|"},
  {"a leaf that goes on as ever is told what it should do, and ends as ever",
   "ParallelAbsolute[barriers=1 pace=true reaction=0](a b)", "a+.1 b+.5", 1,
   "start tick| set_pace=0.111 tick||"},
  {"nodes multiply their factors",
   "ParallelAbsolute[barriers=1 pace=true reaction=0](a ParallelAbsolute[barriers=1 pace=true reaction=0](b c))",
   "a+.05 b+.1 c+.2*0", 2, "start tick| set_pace=0.211 tick| set_pace=0.185 tick|"},
  {"where no barrier is left, nobody is slowed",
   "ParallelAbsolute[barriers=.2 pace=true reaction=0](a b)", "a+.1 b+.19*0", 1,
   "start tick| set_pace=0.053 tick| set_pace=1 tick|"},
  {"a node that ends before all have come slows nobody with a delta",
   "ParallelRelative[delta=.5 success_count=1 pace=true reaction=0](a b)", "a+.1 b+.2*0", 1,
   "start tick| tick| tick|"},
  {"nor at a barrier at 1, but at those before it",
   "ParallelAbsolute[barriers=.3;1 success_count=1 pace=true reaction=0](a b)", "a+.1 b+.2*0", 1,
   "start tick| set_pace=0.25 tick| tick| set_pace=1 tick|"},
  {"a new activation is at full speed again",
   "Repeat[times=2](ParallelAbsolute[barriers=1 pace=true reaction=0](a b))", "a+.5 b+.8*0", 1,
   "start tick| set_pace=0.25 tick|start tick|"},
  {"guards are not told",
   "ParallelAbsolute[barriers=1 pace=true reaction=0](c? a b)", "c=S a+.1 b+.2*0", 0,
   "start tick| start tick| start tick|"},
  {"nobody is told by a node without pace",
   "ParallelAbsolute[barriers=1](a b)", "a+.1 b+.2*0", 1, "start tick| tick| tick|"},
};
// clang-format on

TEST_CASE("pacing: what leaves are told") {
  for (const PaceRow& row : kPaceRows) {
    INFO(row.law);
    const auto ticks = std::count(row.told.begin(), row.told.end(), '|');
    std::string seen = told(row.tree, row.leaves, row.leaf, static_cast<int>(ticks));
    const auto plain = [](std::string_view text) {
      std::string kept;
      for (const char it : text) {
        if (it != ' ' || (!kept.empty() && kept.back() != '|')) kept += it;
      }
      return kept;
    };
    CHECK(plain(seen) == plain(row.told));
  }
}

// In how many ticks of 0.1 s the first child of a node that is slowed to a half ends.
int ticks_of_slowed(const std::string& child, const std::string& leaves) {
  ScriptedRun run("ParallelAbsolute[barriers=1 pace=true reaction=0](slow " + child + ")",
                  "slow+.01 " + leaves);
  for (int tick = 0; tick < 200; ++tick) {
    run.tick(tick * std::chrono::milliseconds(100));
    if (run.ticker().status(2) != Status::Running) return tick;
  }
  return 200;
}

TEST_CASE("pacing: times in a slowed child are slow, too") {
  // 2 s alone. Slowed, it is as long as its partner.
  CHECK(ticks_of_slowed("Timeout[seconds=3](b)", "b+.05*0") == 99);
  CHECK(ticks_of_slowed("Timeout[seconds=3 clock=wall](b)", "b+.05*0") == 30);
  CHECK(ticks_of_slowed("Wait[seconds=2]", "") >= 98);
}

// It begins in tick 1, is slowed there, is held from tick 2 on, and gets its next tick in tick 8.
TEST_CASE(
    "pacing: Timeout and Delay by the wall clock count while their child is slowed, and while it "
    "is held") {
  const auto status_of_leaf = [](const std::string& node) {
    ScriptedRun run("ParallelAbsolute[barriers=.3;.4;.75 pace=true](a Sequence[memory=true](b " +
                        node + "[seconds=.7 clock=wall](c)))",
                    "a+.05*.2 b=R.3S c=R.05");
    for (int tick = 0; tick < 8; ++tick) run.tick(tick * std::chrono::milliseconds(100));
    REQUIRE(run.ticker().held(4));
    run.tick(std::chrono::milliseconds(800));
    return run.ticker().status(5);
  };
  CHECK(status_of_leaf("Timeout") == Status::Idle);
  CHECK(status_of_leaf("Delay") == Status::Running);
}

// Its barrier asks nothing of a guard, so all that counts is what comes from around it. That falls
// in tick 6, when `a` succeeds.
TEST_CASE("pacing: a guard that is a member of a barrier gets what comes from around it") {
  const auto first_tick_of_guard = [](const std::string& pace) {
    ScriptedRun run(
        "ParallelAbsolute[pace=true reaction=.1 barriers=1 hold=between](a Sequence[memory=true]("
        "b SyncProgress[barrier=g](Delay[seconds=.35](c?))) SyncProgress[barrier=g](d)) "
        "barrier[name=g barriers=.2;.6 hold=between" +
            pace + "]",
        "a=R.25R.35R.55R.65RS b=R.3R.55R.75R.85R.95S c=S d=R.1R.15R.25");
    int tick = 0;
    for (; tick < 30 && run.ticker().status(6) == Status::Idle; ++tick) {
      run.tick(tick * std::chrono::milliseconds(100));
    }
    return tick;
  };
  const int alone = first_tick_of_guard("");
  CHECK(alone > 10);
  CHECK(first_tick_of_guard(" pace=true reaction=1") == alone);
}

}  // namespace
}  // namespace lockstep::host::test

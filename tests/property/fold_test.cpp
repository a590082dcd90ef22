// A run whose state is folded after each tick, and says of a node that it is held only where some
// node reads that, does what the same run does that is not: on the random trees of both languages.
// A state that forgets what some node reads would be a wrong proof.
#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>

#include "property/btcpp_tree.h"
#include "property/comparison.h"
#include "property/folded_run.h"

namespace lockstep::host::test {
namespace {

constexpr std::uint64_t kFoldTrees = 1000;
constexpr std::uint64_t kDocuments = 6000;
constexpr int kFoldTicks = 40;

// What is seen of a tick. Below a node that has ended, nothing is.
struct Seen {
  Status status;
  EventLog events;
  std::vector<Activity> activity = {};
  std::vector<double> progress = {};
  std::vector<Value> entries = {};

  friend bool operator==(const Seen&, const Seen&) = default;
};

Seen seen_in(ScriptedRun& run, Nanoseconds now) {
  run.events.clear();
  const Status status = run.tick(now);
  Seen seen{.status = status, .events = run.events};
  Ticker& ticker = run.ticker();
  for (NodeIndex node = 0; node < run.tree().nodes.size(); ++node) {
    seen.activity.push_back(ticker.activity(node));
    seen.progress.push_back(ticker.progress(node));
    if (has_ended(ticker.status(node))) node = ticker.end_of(node) - 1;
  }
  for (const Entry& entry : ticker.blackboard().entries) seen.entries.push_back(entry.value());
  return seen;
}

// How many states a run goes through in 1,000 ticks.
std::size_t count_states(std::string_view tree, std::string_view leaves) {
  ScriptedRun run(tree, leaves);
  std::vector<RunState> states;
  for (int tick = 0; tick < 1000; ++tick) {
    run.tick(std::chrono::milliseconds(100));
    run.ticker().fold();
    if (std::ranges::find(states, run.ticker().run_state()) == states.end()) {
      states.push_back(run.ticker().run_state());
    }
  }
  return states.size();
}

struct Endless {
  std::string_view tree, leaves;
  std::size_t states;
};

// clang-format off
constexpr Endless kEndless[] = {
  {"Repeat(a)", "a=RRS...", 2},
  {"Repeat[times=3](a)", "a=RS...", 6},
  {"Repeat(Sequence[memory=true](a b))", "a=RS... b=RRS...", 3},
  {"Repeat(Wait[seconds=.3])", "", 4},
  {"Repeat(Timeout[seconds=100](a))", "a=RS...", 2},
  {"Repeat(ForceSuccess(Rate[seconds=.2](a)))", "a=S...", 2},
  {"Repeat(Fallback(Cooldown[seconds=.2](a) b))", "a=F... b=S...", 2},
  {"Parallel(UseResources[pool=p resources=A](a) UseResources[pool=p resources=A](b)) resources[name=p]",
   "a=R... b=R...", 3},
  {"Parallel(UseResources[pool=p resources=A keep=true](a) UseResources[pool=p resources=A](b)) resources[name=p]",
   "a=R... b=R...", 4},
  {"Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   "a=R.1 b=R.6", 2},
};
// clang-format on

using Write = std::function<void(ScriptedRun&, int tick)>;

// The folded run begins at time 0 again in each tick.
void check_folded(ScriptedRun& plain, ScriptedRun& folded, double period, const Write& write) {
  for (int tick = 0; tick < kFoldTicks && plain.ticker().fault() == nullptr; ++tick) {
    INFO("tick " << tick);
    write(plain, tick);
    write(folded, tick);
    const Nanoseconds step = from_seconds(period);
    REQUIRE(seen_in(folded, tick == 0 ? Nanoseconds(0) : step) == seen_in(plain, tick * step));
    fold(folded);
  }
}

void check_folded(const Trial& trial) {
  const auto tree = tree_of(trial).tree;
  if (!tree) return;
  INFO(tree_text(trial.plan) << "\n" << leaves_text(trial.plan));
  ScriptedRun plain(*tree, leaves_text(trial.plan)), folded(*tree, leaves_text(trial.plan));
  check_folded(plain, folded, trial.period,
               [&](ScriptedRun& run, int tick) { write_entries(run, trial, tick); });
}

}  // namespace

TEST_CASE("every node kind that keeps something says how it is folded") {
  for (const LanguageRules* rules : languages()) {
    for (const NodeKind* kind : rules->kinds) {
      INFO(kind->type.id);
      const bool keeps = kind->state_size + kind->state_per_child > 0;
      CHECK((kind->fold != nullptr) == keeps);
    }
  }
  for (const NodeKind* mock : {&kMockAction, &kMockCondition, &kMockControl, &kMockDecorator}) {
    CHECK((mock->fold != nullptr) == (mock->state_size + mock->state_per_child > 0));
  }
}

TEST_CASE("a node kind that notes when it is held says so") {
  for (const LanguageRules* rules : languages()) {
    for (const NodeKind* kind : rules->kinds) {
      INFO(kind->type.id);
      CHECK((kind->pause != nullptr) == kind->reads_own_hold);
    }
  }
  CHECK(kMockAction.reads_own_hold);
}

TEST_CASE("an endless run goes through a few states") {
  for (const Endless& it : kEndless) {
    INFO(it.tree << ", " << it.leaves);
    CHECK(count_states(it.tree, it.leaves) == it.states);
  }
}

TEST_CASE("a run that is folded after each tick goes on as the run that is not") {
  for (std::uint64_t seed = 0; seed < kFoldTrees; ++seed) {
    INFO("seed " << seed);
    check_folded(random_trial(seed));
    check_folded(random_group_trial(seed));
  }
}

TEST_CASE("a folded run of a tree for BehaviorTree.CPP goes on as the run that is not") {
  for (std::uint64_t seed = 1; seed <= kDocuments; ++seed) {
    const law::Document document = law::random_document(seed);
    INFO("seed " << seed << ": " << law::leaves_text(document) << "\n" << law::to_xml(document));
    const Tree tree = law::tree_of(document);
    ScriptedRun plain(tree, law::leaves_text(document)), folded(tree, law::leaves_text(document));
    check_folded(plain, folded, 0.1, [](ScriptedRun&, int) {});
  }
}

}  // namespace lockstep::host::test

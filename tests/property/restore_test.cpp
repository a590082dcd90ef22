// A run that is taken back to an earlier moment goes on as it did from there: on the random trees
// of both languages.
#include <catch2/catch.hpp>
#include <functional>

#include "dialect/btcpp/rules.h"
#include "engine/node_ports.h"
#include "property/btcpp_tree.h"
#include "property/comparison.h"
#include "support/scripted_types.h"
#include "support/tree_text.h"

namespace lockstep::host::test {
namespace {

constexpr std::uint64_t kRestoreTrees = 300;
constexpr int kRestoreTicks = 30;

// What is seen of a tick.
struct Seen {
  Status status;
  EventLog events;
  RunState run;
  std::vector<Value> entries;
  std::vector<double> progress;
  std::size_t went_on;  // leaves that did while they were held

  friend bool operator==(const Seen&, const Seen&) = default;
};

// A run that may be taken to any tick; `before` is what is done from outside before one.
class Walk {
 public:
  Walk(ScriptedRun& run, double period, std::function<void(int)> before)
      : run_(run), period_(period), before_(std::move(before)) {}

  Seen tick(int number) {
    run_.events.clear();
    before_(number);
    Seen seen{.status = run_.tick(number * from_seconds(period_)),
              .events = run_.events,
              .run = run_.ticker().run_state(),
              .entries = {},
              .progress = {},
              .went_on = run_.ticker().went_on().size()};
    for (const Entry& entry : run_.ticker().blackboard().entries) {
      seen.entries.push_back(entry.value());
    }
    for (NodeIndex node = 0; node < run_.tree().nodes.size(); ++node) {
      seen.progress.push_back(run_.ticker().progress(node));
    }
    return seen;
  }

  // From each third tick, the last first, all comes again as it was.
  void check() {
    std::vector<ScriptedRun::Saved> saved;
    std::vector<Seen> seen;
    for (int number = 0; number < kRestoreTicks; ++number) {
      saved.push_back(run_.save());
      seen.push_back(tick(number));
    }
    for (int from = kRestoreTicks - 1; from >= 0; from -= 3) {
      run_.restore(saved[static_cast<std::size_t>(from)]);
      for (int number = from; number < kRestoreTicks; ++number) {
        INFO("taken back to tick " << from << ", at tick " << number);
        REQUIRE(tick(number) == seen[static_cast<std::size_t>(number)]);
      }
    }
  }

 private:
  ScriptedRun& run_;
  const double period_;
  const std::function<void(int)> before_;
};

void check_restored(const Trial& trial) {
  auto tree = tree_of(trial).tree;
  if (!tree) return;
  for (LeafNode& leaf : tree->leaves) {
    if (leaf.type->leaf == &kScriptedAction && leaf.node % 2 == 0)
      leaf.type = &kStartlessActionType;
  }
  INFO(tree_text(trial.plan));
  ScriptedRun run(*tree, leaves_text(trial.plan));
  Walk(run, trial.period, [&](int tick) { write_entries(run, trial, tick); }).check();
}

}  // namespace

TEST_CASE("a run that is taken back goes on as it did") {
  for (std::uint64_t seed = 0; seed < kRestoreTrees; ++seed) {
    INFO("seed " << seed);
    check_restored(random_trial(seed));
    check_restored(random_group_trial(seed));
  }
}

TEST_CASE("a run that is taken back to before a fault has it again") {
  ScriptedRun run(
      "Parallel(UseResources[pool=p resources=A](Fallback(a d)) UseResources[pool=p "
      "resources=A](b))"
      " resources[name=p]",
      "a=R!pause b=R d=R", FaultPolicy::Fail);
  Walk(run, 0.1, [](int) {}).check();
}

TEST_CASE("a run that is taken back may go on otherwise: a parameter is what its entry says then") {
  ScriptedRun run("Wait[seconds={time}]", "");
  run.set("time", 1.0);
  run.tick(from_seconds(0));
  const ScriptedRun::Saved saved = run.save();
  run.set("time", 5.0);
  CHECK(run.tick(from_seconds(0.2)) == Status::Running);
  run.restore(saved);
  run.set("time", 0.1);  // written as often as the other value was
  CHECK(run.tick(from_seconds(0.2)) == Status::Success);
}

TEST_CASE("a run that is taken back has what it had kept, and the entries that it had made") {
  Tree tree = tree_from_text("a", btcpp::kRules);
  tree.boards.resize(1);  // names are looked up while it runs
  ScriptedRun run(std::move(tree), "a=R");
  Ticker& ticker = run.ticker();
  const auto write = [&](std::string_view key, std::int64_t number) {
    Entry& entry = ticker.ports().at(0, key);
    make_entry(entry, Typing::Any);
    entry.assign(number);
  };
  write("before", 1);
  ticker.kept_values()[0] = std::int64_t{1};
  const ScriptedRun::Saved saved = run.save();
  write("before", 2);
  write("after", 2);
  ticker.kept_values()[0] = std::int64_t{2};
  run.restore(saved);
  CHECK(ticker.ports().at(0, "before").value() == Value(std::int64_t{1}));
  CHECK_FALSE(ticker.ports().at(0, "after").is_present);
  CHECK(ticker.kept_values()[0] == Value(std::int64_t{1}));
}

TEST_CASE("a run of a tree for BehaviorTree.CPP that is taken back goes on as it did") {
  for (std::uint64_t seed = 1; seed <= kRestoreTrees; ++seed) {
    const law::Document document = law::random_document(seed);
    INFO("seed " << seed << ": " << law::to_xml(document));
    ScriptedRun run(law::tree_of(document), law::leaves_text(document));
    Walk(run, 0.1, [](int) {}).check();
  }
}

}  // namespace lockstep::host::test

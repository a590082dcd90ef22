// A run that is taken back to an earlier moment goes on as it did from there: on the random trees
// of both languages. So does one that goes on as bytes in another run, of another copy of the tree.
#include <catch2/catch.hpp>
#include <functional>

#include "dialect/btcpp/rules.h"
#include "engine/node_ports.h"
#include "property/btcpp_tree.h"
#include "property/comparison.h"
#include "run/checkpoint/run_bytes.h"
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
  using Before = std::function<void(ScriptedRun&, int)>;
  using Again = std::function<std::unique_ptr<ScriptedRun>()>;
  Walk(ScriptedRun& run, double period, Before before)
      : run_(run), period_(period), before_(std::move(before)) {}

  Seen tick(int number) {
    run_.events.clear();
    before_(run_, number);
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
  void check(const Again& another = {}) {
    std::vector<ScriptedRun::Saved> saved;
    std::vector<Seen> seen;
    for (int number = 0; number < kRestoreTicks; ++number) {
      saved.push_back(run_.save());
      seen.push_back(tick(number));
    }
    for (int from = 1; another && from < kRestoreTicks; from += 9) {
      check_as_bytes(from, saved[static_cast<std::size_t>(from)], seen, another);
    }
    for (int from = kRestoreTicks - 1; from >= 0; from -= 3) {
      run_.restore(saved[static_cast<std::size_t>(from)]);
      for (int number = from; number < kRestoreTicks; ++number) {
        INFO("taken back to tick " << from << ", at tick " << number);
        REQUIRE(tick(number) == seen[static_cast<std::size_t>(number)]);
      }
    }
  }

  void check_as_bytes(int from, const ScriptedRun::Saved& saved, const std::vector<Seen>& seen,
                      const Again& another) {
    std::string bytes;
    append_bytes(parts_of(saved.engine), {}, bytes);
    const auto run = another();
    ScriptedRun::Saved read{.engine = {}, .leaves = saved.leaves, .tree_tick = saved.tree_tick};
    LeafBytes leaves;
    REQUIRE(read_bytes(bytes, run->tree(), read.engine, leaves));
    std::string again;
    append_bytes(parts_of(read.engine), leaves, again);
    REQUIRE(again == bytes);
    CHECK_FALSE(read_bytes(bytes + '\0', run->tree(), read.engine, leaves));
    for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 20) {
      SavedRun none;
      CHECK_FALSE(read_bytes(std::string_view(bytes).substr(0, size), run->tree(), none, leaves));
    }
    run->go_on_as(read);
    Walk walk(*run, period_, before_);
    for (int number = from; number < kRestoreTicks; ++number) {
      INFO("as bytes from tick " << from << ", at tick " << number);
      REQUIRE(walk.tick(number) == seen[static_cast<std::size_t>(number)]);
    }
  }

 private:
  ScriptedRun& run_;
  const double period_;
  const Before before_;
};

void check_restored(const Trial& trial) {
  auto tree = tree_of(trial).tree;
  if (!tree) return;
  for (LeafNode& leaf : tree->leaves) {
    if (leaf.type->leaf == &kScriptedAction && leaf.node % 2 == 0)
      leaf.type = &kStartlessActionType;
  }
  INFO(tree_text(trial.plan));
  const auto make = [&] { return std::make_unique<ScriptedRun>(*tree, leaves_text(trial.plan)); };
  const auto run = make();
  Walk(*run, trial.period, [&](ScriptedRun& it, int tick) {
    write_entries(it, trial, tick);
  }).check(make);
}

// From a tick on with new leaves: each of them begins before anything else of it is called.
void check_cut(const Trial& trial, int from) {
  const auto tree = tree_of(trial).tree;
  if (!tree) return;
  INFO(tree_text(trial.plan) << ", cut before tick " << from);
  ScriptedRun run(*tree, leaves_text(trial.plan));
  const auto tick = [&](ScriptedRun& it, int number) {
    write_entries(it, trial, number);
    it.tick(number * from_seconds(trial.period));
  };
  for (int number = 0; number < from; ++number) tick(run, number);
  SavedRun saved;
  run.ticker().save(saved);
  ScriptedRun again(*tree, leaves_text(trial.plan));
  again.ticker().restore(saved);
  const auto cut = again.ticker().go_on_after_cut();
  for (const CutLeaf& leaf : cut) {
    const NodeIndex node = tree->leaves[leaf.place].node;
    REQUIRE(again.ticker().activity(node) == run.ticker().activity(node));
    REQUIRE(again.ticker().progress(node) == 0);
  }
  std::vector<bool> has_begun(tree->leaves.size());
  for (int number = from; number < kRestoreTicks; ++number) {
    INFO("tick " << number);
    for (NodeIndex node = 0; node < tree->nodes.size(); ++node) again.ticker().progress(node);
    again.events.clear();
    tick(again, number);
    for (const Event& event : again.events) {
      const bool has_start = tree->leaves[event.leaf].type->leaf->start != nullptr;
      if (event.call == (has_start ? Call::Start : Call::Tick)) has_begun[event.leaf] = true;
      REQUIRE(has_begun[event.leaf]);
    }
    for (std::size_t place = 0; place < has_begun.size(); ++place) {
      REQUIRE((has_begun[place] || again.leaf(place).asked() == 0));
    }
  }
}

}  // namespace

TEST_CASE("after a cut, each leaf that ran begins again, and nothing else of it is called before") {
  for (std::uint64_t seed = 0; seed < kRestoreTrees; ++seed) {
    INFO("seed " << seed);
    for (const int from : {1, 4, 11}) {
      check_cut(random_trial(seed), from);
      check_cut(random_group_trial(seed), from);
    }
  }
}

TEST_CASE("after a cut, a leaf that was held stays held, and others may have a result") {
  ScriptedRun run("ParallelAbsolute[barriers=0.5](a b)", "a+.5 b+.1");
  for (int number = 0; number < 3; ++number) run.tick(number * from_seconds(0.1));
  REQUIRE(run.ticker().held(1));
  SavedRun saved;
  run.ticker().save(saved);
  ScriptedRun again("ParallelAbsolute[barriers=0.5](a b)", "a+.5 b+.1");
  again.ticker().restore(saved);
  auto cut = again.ticker().cut_leaves();
  REQUIRE(cut.size() == 2);
  again.ticker().go_on_after_cut(cut);
  CHECK(again.ticker().held(1));
  ScriptedRun failed("ParallelAbsolute[barriers=0.5](a b)", "a+.5 b+.1");
  failed.ticker().restore(saved);
  for (CutLeaf& leaf : cut) leaf.does = AfterCut::Failure;
  failed.ticker().go_on_after_cut(cut);
  CHECK(failed.tick(from_seconds(0.3)) == Status::Failure);
  CHECK(failed.events.empty());
}

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
  Walk(run, 0.1, [](ScriptedRun&, int) {}).check();
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
    const auto make = [&] {
      return std::make_unique<ScriptedRun>(law::tree_of(document), law::leaves_text(document));
    };
    const auto run = make();
    Walk(*run, 0.1, [](ScriptedRun&, int) {}).check(make);
  }
}

}  // namespace lockstep::host::test

// What moments tell of a tick, against what the nodes themselves did in it: on random trees of both
// languages, each result and each halt of a node is told, in order, and no other. The one who is
// told within the tick (NodeWatch) shares nothing with moments.
#include <catch2/catch.hpp>
#include <map>
#include <numeric>

#include "engine/node_watch.h"
#include "property/btcpp_tree.h"
#include "property/random_tree.h"
#include "support/scripted_run.h"

namespace lockstep::host::test {
namespace {

// The results of each node, and "halt".
using Told = std::vector<std::vector<std::string>>;

class Witness final : public NodeWatch {
 public:
  explicit Witness(std::size_t nodes) : told(nodes) {}

  std::optional<Status> before_tick(NodeIndex) override { return std::nullopt; }
  std::optional<Status> after_tick(NodeIndex node, Status status) override {
    if (has_ended(status)) told[node].emplace_back(to_string(status));
    return std::nullopt;
  }
  void before_halt(NodeIndex node) override { told[node].emplace_back("halt"); }
  void after_halt(NodeIndex) override {}

  Told told;
};

void add(std::vector<std::string>& told, NodeState before, NodeState now, std::uint64_t times) {
  if (before.status() == Status::Running && now.status() == Status::Idle) told.emplace_back("halt");
  for (std::uint64_t i = 0; i < times && now.ticked() && has_ended(now.status()); ++i) {
    told.emplace_back(to_string(now.status()));
  }
}

// What somebody knows who has moments, and the state before and after the tick.
Told told_by(const MomentsView& moments, std::vector<NodeState> before,
             const std::vector<NodeState>& after) {
  Told told(after.size());
  if (moments.empty()) {
    for (std::size_t i = 0; i < after.size(); ++i) add(told[i], before[i], after[i], 1);
    return told;
  }
  std::vector<NodeState> column;
  moments.each(column, [&](std::span<const NodeState> now, const TickMoment& moment, bool) {
    for (std::size_t i = 0; i < now.size(); ++i) add(told[i], before[i], now[i], moment.times);
    before.assign(now.begin(), now.end());
  });
  CHECK(column == after);
  return told;
}

std::vector<NodeState> states(const Ticker& ticker) {
  std::vector<NodeState> all;
  for (NodeIndex node = 0; node < ticker.tree().nodes.size(); ++node) {
    all.push_back(ticker.node_state(node));
  }
  return all;
}

std::string text(const std::vector<std::string>& told) {
  std::string all;
  for (std::size_t i = 0; i < told.size(); ++i) {
    // What runs and is skipped was halted.
    const bool is_implied = told[i] == "halt" && i + 1 < told.size() && told[i + 1] == "skipped";
    if (!is_implied) all += told[i] + ' ';
  }
  return all;
}

struct Counts {
  std::size_t ticks = 0, with_moments = 0, results = 0;
};

void compare(ScriptedRun& run, int ticks, Counts& counts) {
  Ticker& ticker = run.ticker();
  const Tree& tree = ticker.tree();
  std::vector<NodeIndex> all(tree.nodes[0].end);
  std::iota(all.begin(), all.end(), NodeIndex{0});
  Witness witness(tree.nodes.size());
  ticker.keep_moments();
  ticker.watch_nodes(all, &witness);
  for (int tick = 0; tick < ticks; ++tick) {
    const std::vector<NodeState> before = states(ticker);
    witness.told.assign(tree.nodes.size(), {});
    Status status = ticker.tick_root(tick * std::chrono::milliseconds(100));
    for (int again = 1; ticker.take_request() && status == Status::Running && again < 200;
         ++again) {
      status = ticker.tick_root_again();
    }
    if (ticker.faulted()) break;
    const MomentsView moments = ticker.moments();
    if (!moments.rest.empty()) continue;
    const Told told = told_by(moments, before, states(ticker));
    for (NodeIndex node = 0; node < tree.nodes[0].end; ++node) {
      INFO("tick " << tick << ", " << tree.path(node) << ", moments: " << moments.moments.size());
      REQUIRE(text(told[node]) == text(witness.told[node]));
      counts.results += told[node].size();
    }
    ++counts.ticks;
    counts.with_moments += moments.empty() ? 0 : 1;
  }
  ticker.watch_nodes({}, nullptr);
}

}  // namespace

TEST_CASE(
    "a tick in which a node goes on that was held, and ends what is below it, is one moment") {
  ScriptedRun run("ParallelRelative[delta=0](a Fallback(b Parallel(c? d) Wait[seconds=0.2]))",
                  "a=RR.5R b=FS c=F d=S");
  run.ticker().keep_moments();
  for (int tick = 0; tick < 3; ++tick) {
    run.tick_root(tick * std::chrono::milliseconds(100));
    CHECK(run.ticker().moments().empty());
  }
  CHECK(run.ticker().status(2) == Status::Success);
}

TEST_CASE("moments tell each result and each halt of a tick: trees for BehaviorTree.CPP") {
  Counts counts;
  for (std::uint64_t seed = 1; seed <= 3'000; ++seed) {
    const law::Document document = law::random_document(seed);
    // A condition that keeps its result counts as ticked, and is not (Unreset::KeepsResult).
    const std::string xml = law::to_xml(document);
    if (xml.find("Else") != std::string::npos) continue;
    INFO("seed " << seed << "\n" << law::to_xml(document) << "\n" << law::leaves_text(document));
    ScriptedRun run(law::tree_of(document), law::leaves_text(document));
    compare(run, 12, counts);
  }
  CHECK(counts.with_moments > counts.ticks / 20);
  CHECK(counts.results > counts.ticks);
}

TEST_CASE("moments tell each result and each halt of a tick: lockstep's own language") {
  Counts counts;
  for (std::uint64_t seed = 0; seed < 1'000; ++seed) {
    const Trial trial = random_trial(seed);
    INFO("seed " << seed << ": " << tree_text(trial.plan) << ", " << leaves_text(trial.plan));
    ScriptedRun run(tree_text(trial.plan), leaves_text(trial.plan));
    compare(run, 30, counts);
  }
  CHECK(counts.with_moments > 100);
  CHECK(counts.with_moments < counts.ticks / 4);  // nearly all ticks have one
}

}  // namespace lockstep::host::test

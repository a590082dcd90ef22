// For how many ticks in a row a child may be held: no run holds it longer, the tick in which its
// holder ends included.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "judge/measure/synchronized_ticks.h"
#include "run/live_moments.h"
#include "verify/labels.h"
#include "verify/verified.h"

namespace lockstep::host::test {
namespace {

// What some random runs show of each holdable child: the most ticks in a row in which it was held.
class HoldWalks {
 public:
  explicit HoldWalks(const Verified& it)
      : it_(it),
        held_(holdable(it.tree)),
        most_(held_.size()),
        stepper_(it.tree, it.models, {}, it.rate, kNone, false) {}

  void walk(std::mt19937& random) {
    const Shape shape = shape_of(it_.tree);
    LiveMoments moments(it_.tree);
    std::vector<SynchronizedTicks> nodes;
    for (const NodeIndex node : synchronized_nodes(shape)) nodes.emplace_back(shape, node);
    std::vector<std::uint64_t> row(held_.size());
    StateBytes state = stepper_.first_state();
    for (int tick = 0; tick < 60; ++tick) {
      // One of all combinations of answers.
      std::size_t combinations = 1;
      stepper_.load(state, tick == 0);
      for (stepper_.tick(); stepper_.next(); ++combinations) stepper_.tick();
      stepper_.load(state, tick == 0);
      Status status = stepper_.tick();
      for (auto i = random() % combinations; i > 0; --i) {
        stepper_.next();
        status = stepper_.tick();
      }
      count(moments.after_tick(stepper_.ticker(), 0, {}), nodes, row);
      if (status != Status::Running || stepper_.ticker().faulted()) return;
      stepper_.fold();
      state = stepper_.in_place();
    }
  }

  const std::vector<Holdable>& held() const { return held_; }
  std::uint64_t most(std::size_t child) const { return most_[child]; }

 private:
  void count(const Moment& moment, std::vector<SynchronizedTicks>& nodes,
             std::vector<std::uint64_t>& row) {
    for (SynchronizedTicks& node : nodes) {
      const SynchronizedTick tick = node.read(moment);
      for (std::size_t i = 0; i < node.children().size(); ++i) {
        const auto it = std::ranges::find(held_, node.children()[i], &Holdable::child);
        if (it == held_.end()) continue;
        const auto child = static_cast<std::size_t>(it - held_.begin());
        row[child] = i < tick.held.size() && tick.held[i] ? row[child] + 1 : 0;
        most_[child] = std::max(most_[child], row[child]);
      }
    }
  }

  static inline const Symmetry kNone;
  const Verified& it_;
  std::vector<Holdable> held_;
  std::vector<std::uint64_t> most_;
  Stepper stepper_;
};

constexpr auto kFifths =
    R"(<leaf path="*" progress="grid:5" result="success" step="0..1" finish="full"/>)";

// clang-format off
struct HoldRow {
  std::string_view tree, rows, child, most;
};
constexpr HoldRow kHoldRows[] = {
  // b is two steps ahead after two ticks, and a has three until its time is over, in the fourth.
  {"ParallelRelative[delta=.2](Timeout[seconds=.5](a) b)", kFifths, "ParallelRelative/b", "at most 4 ticks"},
  {"Fallback[memory=true](ParallelRelative[delta=.2](Timeout[seconds=.5](a) b) d)", kFifths,
   "Fallback/ParallelRelative/b", "at most 4 ticks"},
  {"ParallelAbsolute[barriers=.5](Timeout[seconds=.3](a) b)", R"(<leaf path="*" finish="full"/>)",
   "ParallelAbsolute/b", "at most 3 ticks"},
  {"Parallel(Timeout[seconds=.3](SyncProgress[barrier=g](a)) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]",
   R"(<leaf path="*" finish="full"/>)", "Parallel/SyncProgress/b", "at most 3 ticks"},
  {"ParallelAbsolute[barriers=.5](a b)", R"(<leaf path="*" finish="full" ticks="1..4" result="success"/>)",
   "ParallelAbsolute/b", "at most 3 ticks"},
};
// clang-format on

}  // namespace

TEST_CASE("holds: the tick in which the holder ends counts, as in the measure 'held'") {
  for (const HoldRow& row : kHoldRows) {
    INFO(row.tree);
    const Verified it(row.tree, row.rows);
    const std::string name = "held: " + it.tree.id + '/' + std::string(row.child);
    CHECK(it.said(name) == row.most);
    HoldWalks walks(it);
    std::mt19937 random(1);
    for (int i = 0; i < 2000; ++i) walks.walk(random);
    for (std::size_t child = 0; child < walks.held().size(); ++child) {
      if ("held: " + it.tree.path(walks.held()[child].child) != name) continue;
      CHECK("at most " + std::to_string(walks.most(child)) + " ticks" == row.most);
    }
  }
}

TEST_CASE("holds: no random run holds a child longer than the verdict says") {
  const std::vector<std::string> trees{
      "ParallelAbsolute[barriers=.25;.5](a Retry[attempts=2](b) c?)",
      "ParallelRelative[delta=.25](Sequence[memory=true](a b) Timeout[seconds=.3](d))",
      "Parallel(SyncProgress[barrier=g](a) Retry[attempts=3](SyncProgress[barrier=g](b))) "
      "barrier[name=g barriers=.5]",
      "ParallelAbsolute[barriers=.5](ParallelAbsolute[barriers=.5](a b) d)",
      "Repeat[times=2](ParallelAbsolute[barriers=.5](a b d))",
      "Parallel(UseResources[pool=p resources=A](a) UseResources[pool=p resources=A](b) "
      "UseResources[pool=p resources=A](d)) resources[name=p]",
  };
  std::mt19937 random(2);
  std::size_t bounded = 0, reached = 0;
  for (const std::string& tree : trees) {
    for (const std::string ticks : {"1..3", "2..4", "1..2"}) {
      INFO(tree << ' ' << ticks);
      const bool has_delta = tree.find("delta") != std::string::npos;
      const Verified it(tree, "<leaf path=\"*\" finish=\"full\" ticks=\"" + ticks +
                                  "\" progress=\"" + (has_delta ? "grid:4" : "cuts") + "\"/>");
      REQUIRE(it.found.is_complete());
      HoldWalks walks(it);
      for (int i = 0; i < 300; ++i) walks.walk(random);
      for (std::size_t child = 0; child < walks.held().size(); ++child) {
        const std::string said = it.said("held: " + it.tree.path(walks.held()[child].child));
        INFO(it.tree.path(walks.held()[child].child) << " held " << said);
        if (said == "as long as others take" || said == "may be held indefinitely") continue;
        ++bounded;
        const std::uint64_t most =
            said == "never" ? 0 : std::stoull(said.substr(std::string("at most ").size()));
        CHECK(walks.most(child) <= most);
        reached += walks.most(child) == most;
      }
    }
  }
  CHECK(bounded > 20);
  CHECK(reached > bounded / 2);
}

}  // namespace lockstep::host::test

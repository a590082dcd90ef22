// What a search leaves out where leaves are equal, a verdict still knows: small graphs in which it
// matters who has given which answer, and a tick that only one child has shown.
#include <array>
#include <catch2/catch.hpp>

#include "verify/fair_cycle.h"
#include "verify/holds.h"
#include "verify/verified.h"

namespace lockstep::host::test {
namespace {

// Two leaves under a synchronized node, which may change places.
const LabelShape kShape{.leaves = 2,
                        .held = 2,
                        .properties = 0,
                        .moving_leaves = {0, 1},
                        .moving_held = {0, 1},
                        .moving_children = {{1, 1, {{0, 0}, {1, 1}}}}};

enum class Equal : bool { No, Yes };
constexpr LabelShape::EqualChild kEqual{0, 1};

// All stay where they are. Equal: the leaves are in equal states before the tick.
struct Tick {
  StateId from, to;
  std::vector<std::size_t> bits;
  Equal equal;
};

Graph graph_of(StateId states, const std::vector<Tick>& ticks) {
  Graph graph{.edges = {}, .ends = std::vector<bool>(states), .labels = {}, .shape = kShape};
  for (StateId state = 0; state < states; ++state) {
    std::vector<Edge> edges;
    Label label, equals;
    kShape.clear(equals);
    for (const Tick& it : ticks) {
      if (it.from != state) continue;
      kShape.clear(label);
      for (const std::size_t bit : it.bits) label.set(bit);
      edges.push_back({it.to, graph.labels.add(label)});
      if (it.equal == Equal::Yes) kShape.set_equals(std::array{kEqual}, equals);
    }
    graph.edges.add(edges);
    graph.equals.push_back(graph.labels.add(equals));
  }
  return graph;
}

constexpr std::size_t kLeft = 0, kRight = 1;

}  // namespace

TEST_CASE("equal leaves: a cycle is fair if each of them may be the one that ends") {
  const auto ticks = [](Equal equal) {
    return std::vector<Tick>{{0, 0, {kShape.worked_bit(kLeft), kShape.ended_bit(kRight)}, equal}};
  };
  CHECK(fair_cycle(graph_of(1, ticks(Equal::No))).empty());
  const std::vector<CycleStep> cycle = fair_cycle(graph_of(1, ticks(Equal::Yes)));
  REQUIRE_FALSE(cycle.empty());
  // Whoever begins at the left ends on the way.
  std::size_t place = kLeft;
  bool ends = false;
  for (const CycleStep& it : cycle) {
    place = kShape.exchanged(it.swaps[0], place);
    ends |= place == kRight;
  }
  CHECK(ends);
}

TEST_CASE("equal leaves: one that is held goes on to be held where its equal is") {
  const auto longest = [](Equal equal) {
    const Graph graph = graph_of(
        3, {{1, 0, {kShape.held_bit(kLeft)}, Equal::No}, {0, 2, {kShape.held_bit(kRight)}, equal}});
    return Holds(graph, graph, {kLeft, kRight}).longest();
  };
  CHECK(longest(Equal::No) == 1u);
  CHECK(longest(Equal::Yes) == 2u);
}

TEST_CASE("equal leaves: of two that are held, the one counts that is held again") {
  const Graph graph =
      graph_of(3, {{0, 1, {kShape.held_bit(kLeft), kShape.held_bit(kRight)}, Equal::Yes},
                   {1, 2, {kShape.held_bit(kRight)}, Equal::No}});
  CHECK(Holds(graph, graph, {kLeft, kRight}).longest() == 2u);
}

TEST_CASE("equal leaves: where a run says so, they change places behind a tick") {
  const Verified it("Parallel(a b)", R"(<leaf path="*" ticks="2"/>)");
  Tracer tracer(it.tree, it.models, {}, 10, it.found);
  TracedPath traced = tracer.begin();
  const std::vector<GuidedStep> steps{{.from = 0, .after = {kLeft, kRight}}};
  tracer.go(traced, steps);
  const NodeIndex left = it.tree.leaves[0].node, right = it.tree.leaves[1].node;
  CHECK(traced.nodes[left] == right);
  CHECK(traced.nodes[right] == left);
}

TEST_CASE("equal leaves: the one that is held for ever is not the one that works for ever") {
  const Graph graph =
      graph_of(1, {{0,
                    0,
                    {kShape.worked_bit(kLeft), kShape.ended_bit(kRight), kShape.held_bit(kRight)},
                    Equal::Yes}});
  CHECK_FALSE(Holds(graph, graph, {kLeft, kRight}).longest());
  CHECK_FALSE(Holds(graph, graph, {kLeft, kRight}).for_ever());
}

TEST_CASE("equal leaves: a starving one is shown in the places that it has in turn") {
  const Graph graph = graph_of(2, {{0, 1, {kShape.held_bit(kRight)}, Equal::Yes},
                                   {1, 0, {kShape.held_bit(kLeft)}, Equal::Yes}});
  const auto endless = Holds(graph, graph, {kLeft, kRight}).for_ever();
  REQUIRE(endless);
  std::size_t place = endless->child;
  for (const CycleStep& it : endless->cycle) {
    for (const Swap& swap : it.swaps) place = kShape.exchanged(swap, place);
    CHECK(graph.has(it.edge, kShape.held_bit(place)));
    place = kShape.exchanged(it.after, place);
  }
  CHECK(place == endless->child);
}

TEST_CASE("equal children: what one has shown holds for the others") {
  const Verified it(
      "ParallelAbsolute[barriers=.5](ParallelAbsolute[barriers=.5](a b) "
      "ParallelAbsolute[barriers=.5](a b))",
      R"(<leaf path="*" progress="grid:4"/>)");
  REQUIRE_FALSE(it.found.symmetry.empty());
  Stepper stepper(it.tree, it.models, {}, 10, it.found.symmetry, true);
  const StateBytes first = stepper.first_state();
  stepper.load(first, true);
  // Success, failure, or running with a progress: the leaves of the first child are apart.
  stepper.give(std::vector<LeafAnswer>{{0, 2}, {1, 5}, {2, 2}, {3, 2}});
  stepper.tick();
  stepper.fold();
  const StateBytes second = stepper.in_place();
  stepper.load(second, false);
  stepper.give(std::vector<LeafAnswer>{{0, 0}, {2, 2}, {3, 2}});
  stepper.tick();
  SearchCoverage coverage(it.tree);
  coverage.after_tick(stepper.ticker());
  const NodeIndex leaf = it.tree.leaves[0].node;
  const auto spread_of = [&](std::size_t child) {
    return coverage.synchronized()[1 + child].largest_spread;
  };
  CHECK(coverage.has_been(leaf, Status::Success));
  CHECK(spread_of(0) > spread_of(1));
  coverage.spread(it.found.symmetry);
  for (const LeafNode& other : it.tree.leaves) {
    CHECK(coverage.has_been(other.node, Status::Success));
    CHECK(coverage.was_ticked(other.node));
  }
  CHECK(spread_of(0) == spread_of(1));
  CHECK(spread_of(1) > 0);
}

}  // namespace lockstep::host::test

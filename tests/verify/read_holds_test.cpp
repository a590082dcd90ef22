// Members of pools below synchronized nodes: one that such a node has held asks for its resources
// when a tick reaches it, any other one before the root is ticked. So a state of a search says
// which of them are held. And what a state does not say is found by runs without states.
#include <catch2/catch.hpp>
#include <deque>

#include "dialect/btcpp/rules.h"
#include "verify/chance_runs.h"
#include "verify/verified.h"

namespace lockstep::host::test {
namespace {

constexpr auto kEndsFull = R"(<leaf path="*" result="success" finish="full"/>)";

// Two members of a pool, the second of which may be held at 0.5 while the first one has its turn.
const std::string kTwoMembers =
    "ParallelAbsolute[barriers=.5](UseResources[pool=p resources=A](x) "
    "UseResources[pool=p resources=A](y)) resources[name=p increment=0]";

std::optional<Contradiction> contradiction_of(const Tree& tree) {
  Diagnostics diagnostics;
  std::vector<NodeProblem> problems;
  const LeafModels models = make_models(tree, nullptr, diagnostics, problems);
  constexpr double kRate = 10;
  const SearchResult found = search(tree, models, {}, kRate, {});
  return find_contradiction(tree, models, {}, kRate, found, {.time = Nanoseconds::max()});
}

}  // namespace

TEST_CASE("a member that a synchronized node holds lets the others go on, so the tree can end") {
  const Verified it(kTwoMembers, kEndsFull);
  CHECK(it.findings().empty());
  CHECK(it.said("can always end") == "yes");
  CHECK(it.said("results").starts_with("success"));
}

TEST_CASE("what is behind a member is ticked when the one before it is held") {
  const Verified it(
      "ParallelAbsolute[barriers=1](UseResources[pool=p resources=A](x) c? "
      "UseResources[pool=p resources=A](d?)) resources[name=p increment=0]",
      R"(<leaf path="*/x" progress="cuts"/>)", {}, 10, {"never d.ticked"});
  CHECK(it.said("property 'never d.ticked'") == "NO");
  CHECK(it.said("never ticked") == "none");
}

TEST_CASE("a guard that has its turn while the other member is held may retry for ever") {
  const Verified it(
      "ParallelAbsolute[barriers=1](UseResources[pool=p resources=A](Retry[attempts=3](c?)) "
      "UseResources[pool=p resources=A](x)) resources[name=p]");
  CHECK(it.said("always ends").starts_with("NO"));
}

TEST_CASE("what is held in a branch that a tick passes over is still held") {
  // The condition takes time again and again while the branch runs.
  const auto tree = "WhileDoElse(Fallback(Sleep[msec=200]) ParallelAbsolute[barriers=.5](a b))";
  const auto wrong = contradiction_of(tree_from_text(tree, btcpp::kRules));
  CHECK((wrong ? to_text(*wrong) : "") == "");
  const Verified it(tree, "", {}, 10, {"b.held at most 1 ticks"}, btcpp::kRules);
  CHECK(it.said("property 'b.held at most 1 ticks'") == "NO");
}

TEST_CASE("a state that says less than a group reads is contradicted by a run") {
  Tree tree = tree_from_text(kTwoMembers);
  CHECK_FALSE(contradiction_of(tree));
  std::deque<NodeKind> kinds;
  for (Node& node : tree.nodes) {
    if (!node.kind->reads_hold_of_members) continue;
    kinds.push_back(*node.kind);
    kinds.back().reads_hold_of_members = false;
    node.kind = &kinds.back();
  }
  REQUIRE_FALSE(kinds.empty());
  const auto wrong = contradiction_of(tree);
  REQUIRE(wrong);
  CHECK(to_text(*wrong).starts_with("internal error: a run contradicts this proof; the seed is "));
}

TEST_CASE("no run contradicts a search that is right") {
  for (const char* tree :
       {"Sequence(a b)", "Repeat(Sequence[memory=true](a Retry[attempts=2](b?)))",
        "ParallelAbsolute[barriers=.5;1](a b c)",
        "ParallelRelative[delta=.2](a Timeout[seconds=.5](b) Wait[seconds=.4])",
        "Parallel(SyncProgress[barrier=g](a) Fallback[memory=true](b SyncProgress[barrier=g](c))) "
        "barrier[name=g barriers=.5]",
        "Sequence[memory=true](Script[code=n:=0] Parallel(a[while=n<2] b[on_success=n=n+1]))"}) {
    INFO(tree);
    const auto wrong = contradiction_of(tree_from_text(tree));
    CHECK((wrong ? to_text(*wrong) : "") == "");
  }
}

}  // namespace lockstep::host::test

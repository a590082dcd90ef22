// What verify does not look at, for nobody knows what it may do.
#include "verify/verifiable.h"

#include <catch2/catch.hpp>

#include "judge/measure/property_steps.h"
#include "run/shape_of.h"
#include "support/tree_text.h"

namespace lockstep::host::test {
namespace {

// What is said of a tree whose first leaf may write any entry.
std::vector<NodeProblem> with_opening_leaf(const std::string& text) {
  Tree tree = tree_from_text(text);
  NodeType opening = *tree.leaves[0].type;
  opening.opens_entries = true;
  tree.labels[tree.leaves[0].node].type = &opening;
  return not_verifiable(tree);
}

}  // namespace

TEST_CASE("a leaf that may write any entry is refused where the tree reads entries") {
  const auto problems = with_opening_leaf("Sequence(Script[code=n:=0] a)");
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].node == 2);
  CHECK(problems[0].message.ends_with("may write any entry, and the tree reads some"));
  CHECK(with_opening_leaf("Sequence(b a)").empty());
  CHECK(not_verifiable(tree_from_text("Sequence(Script[code=n:=0] a)")).empty());
}

TEST_CASE("the progress of a barrier is no part of a state, so no property compares it") {
  const Tree tree = tree_from_text(
      "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g barriers=1]");
  const auto problems_of = [&](std::string_view text) {
    const std::vector<Property> properties = {
        Property::parse(text, property_names(shape_of(tree))).value()};
    std::vector<NodeProblem> problems;
    CHECK(observed_by(tree, properties, problems).progress.size() == 1);
    return problems.size();
  };
  CHECK(problems_of("never g.progress > 0.25") == 1);
  CHECK(problems_of("never a.progress > 0.25") == 0);
}

}  // namespace lockstep::host::test

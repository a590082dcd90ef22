// What verify does not look at, for nobody knows what it may do.
#include "verify/verifiable.h"

#include <catch2/catch.hpp>

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

}  // namespace lockstep::host::test

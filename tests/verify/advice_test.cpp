// What `check` says of a tree without knowing its leaves: what no behavior can do, and deadlocks
// that some behavior leads to.
#include <algorithm>
#include <catch2/catch.hpp>

#include "support/tree_text.h"
#include "verify/advice.h"

namespace lockstep::host::test {
namespace {

struct AdviceRow {
  std::string_view claim, tree, said;
};

// clang-format off
constexpr AdviceRow kAdviceRows[] = {
  {"what may run is not spoken of", "Fallback[memory=true](a Sequence(c? b))", ""},
  {"behind what never fails", "Fallback(AlwaysSuccess a)",
   "'a' can never run, whatever the leaves do: 'AlwaysSuccess' before it never fails\n"},
  {"of a subtree its root, once", "Sequence(Inverter(AlwaysSuccess) Fallback(a b) c)",
   "'Fallback' can never run, whatever the leaves do: 'Inverter' before it never succeeds\n"
   "'c' can never run, whatever the leaves do: 'Fallback' before it never succeeds\n"},
  {"no rate decides in the first tick", "Fallback(Timeout[seconds=100](AlwaysSuccess) a)",
   "'a' can never run, whatever the leaves do: 'Timeout' before it never fails\n"},
  {"a rate decides, so nothing is certain", "Fallback(Timeout[seconds=100](Wait[seconds=1]) a)", ""},
  {"what a script has written is known", "Sequence[memory=true](Script[code=n:=1] Check[code=n==2] a)",
   "'a' can never run, whatever the leaves do: 'Check' before it never succeeds\n"},
  {"a circle of barriers that may be, but need not", "Parallel(SyncProgress[barrier=coarse](SyncProgress[barrier=fine](a)) "
   "SyncProgress[barrier=coarse](Sequence[memory=true](b SyncProgress[barrier=fine](c)))) "
   "barrier[name=coarse barriers=.5] barrier[name=fine barriers=.25]",
   "held nodes may deadlock: coarse -> fine -> coarse: 'coarse' holds 'Sequence' at 0.5 until 'SyncProgress' comes, which is at 0.25 and has 'a' in it; 'fine' holds 'a' at 0.25 until 'c' comes, which is at 0 and is inside of 'Sequence'\n"},
  {"a barrier that waits for what never comes",
   "Sequence(Parallel(ForceSuccess(SyncProgress[barrier=g](a)) SyncProgress[barrier=g](AlwaysRunning)) b) "
   "barrier[name=g barriers=.5]",
   "'b' can never run, whatever the leaves do: 'Parallel' before it never succeeds\n"
"this tree never ends, whatever its leaves do\n"
"'SyncProgress' may be held by 'g' indefinitely: 'g' holds 'a' at 0.5 until 'AlwaysRunning' comes, which is at 0\n"},
  {"members of a pool that take turns",
   "Parallel(Repeat(UseResources[pool=p resources=A](AlwaysSuccess)) "
   "Repeat(UseResources[pool=p resources=A](AlwaysSuccess))) resources[name=p]",
   "this tree never ends, whatever its leaves do\n"},
  {"a member that waits for one that runs for ever",
   "Parallel(UseResources[pool=p resources=A keep=true](AlwaysRunning) "
   "UseResources[pool=p resources=A](AlwaysSuccess)) resources[name=p]",
   "'AlwaysSuccess' can never run, whatever the leaves do\n"
   "this tree never ends, whatever its leaves do: 'p' keeps A from 'AlwaysSuccess' until 'AlwaysRunning' gives it back, which is at 0\n"},
  {"what a leaf may write while it runs, and with its failure",
   "Sequence[memory=true](Script[code=s:=false] Parallel[success_count=1](Sequence[memory=true](WaitUntil[code=s] AlwaysSuccess) w[flag={s}]))", ""},
  {"progress that falls", "Parallel(a Sequence[memory=true](WaitUntil[code=progress(a)>=0.5] "
   "WaitUntil[code=progress(a)<0.5] b))", ""},
  {"a hook reads what only a later node writes",
   "Sequence[memory=true](a[while=k<2] Script[code=k:=1])",
   "each tick of 'a' is a fault, whatever the leaves do: its while: '<' takes two numbers or two texts, or a "
   "number and the text of one, not the entry 'k' without a value and 2: its while reads 'k', which has no value "
   "yet: 'Script' writes it, which comes after; or give it a value with --set k=…\n"},
  {"a condition reads what only a later node writes",
   "Sequence(Check[code=k<2] Script[code=k:=1])",
   "each tick of 'Check' is a fault, whatever the leaves do: its code: '<' takes two numbers or two texts, or a "
   "number and the text of one, not the entry 'k' without a value and 2: it reads 'k', which has no value yet: "
   "'Script' writes it, which comes after; or give it a value with --set k=…\n"},
  {"a script behind the result reads what only a later node writes",
   "Sequence[memory=true](Script[code=y:=0 on_success=y:=k] Script[code=k:=1])",
   "each tick of 'Script' is a fault, whatever the leaves do: its on_success: cannot assign to 'y': the right side "
   "is the entry 'k' without a value: give it a value with --set k=…\n"},
  {"a parameter that only a later node writes",
   "Sequence[memory=true](Wait[seconds={t}] Script[code=t:=1.5])",
   "each tick of 'Wait' is a fault, whatever the leaves do: 'seconds' has no value: nothing has written the entry "
   "'{t}': give it a value with --set t=…\n"},
  {"a fault that each tick has, by types", "Sequence(Script[code=y:=0] Script[code=y:=y/0] a)",
   "each tick of 'Script' is a fault, whatever the leaves do: its code: cannot assign NaN (such as 0/0) to 'y', "
   "which has the type int\n"},
  {"a fault in some ticks only", "Repeat(Sequence(Script[code=y:=0] Fallback(a Script[code=y:=3]) "
   "Script[code=y:=y/y]))", ""},
  {"in a parallel, whose other children a fault ends too",
   "Parallel(a[while=k<2] Script[code=k:=1])",
   "each tick of 'a' is a fault, whatever the leaves do: its while: '<' takes two numbers or two texts, or a "
   "number and the text of one, not the entry 'k' without a value and 2: its while reads 'k', which has no value "
   "yet: 'Script' writes it, which comes after; or give it a value with --set k=…\n"},
  {"a while of an entry in front of a node that counts time",
   "Parallel(Sequence[while=k<2](Wait[seconds=1] a) Script[code=k:=1])",
   "each tick of 'Sequence' is a fault, whatever the leaves do: its while: '<' takes two numbers or two texts, or "
   "a number and the text of one, not the entry 'k' without a value and 2: its while reads 'k', which has no value "
   "yet: 'Script' writes it, which comes after; or give it a value with --set k=…\n"},
  {"the rate decides which is first",
   "Parallel(Sequence[memory=true](Wait[seconds=0.3] b[while=k<2]) "
   "Sequence[memory=true](Wait[seconds=0.2] Script[code=k:=1]))", ""},
  {"a node before it writes the entry", "Sequence[memory=true](Script[code=k:=1] a[while=k<2])", ""},
  {"an endless tree", "Repeat(ForceSuccess(AlwaysFailure))", "this tree never ends, whatever its leaves do\n"},
  {"a leaf that is skipped ends it", "Repeat(ForceSuccess(a))", "this tree never ends, unless a leaf returns Skipped\n"},
  {"behind what fails only if a leaf is skipped", "Fallback[memory=true](ForceSuccess(a) b)",
   "'b' can never run, unless a leaf returns Skipped: 'ForceSuccess' before it never fails\n"},
};
// clang-format on

std::string said_of(std::string_view text) {
  const Tree tree = tree_from_text(text);
  std::vector<Place> places;
  for (std::uint32_t node = 0; node < tree.nodes.size(); ++node) places.push_back({node});
  std::string said;
  for (const Advice& it : advice_of(tree, places)) {
    said += it.message + (it.hint.empty() ? "" : ": " + it.hint) + '\n';
  }
  return said;
}

}  // namespace

TEST_CASE("check says what is certain, whatever the leaves do, and what may wait for ever") {
  for (const AdviceRow& row : kAdviceRows) {
    INFO(row.claim << ": " << row.tree);
    CHECK(said_of(row.tree) == row.said);
  }
}

TEST_CASE("what a skipped leaf refutes is no warning") {
  const Tree tree = tree_from_text("Fallback[memory=true](ForceSuccess(a) b)");
  std::vector<Place> places;
  for (std::uint32_t node = 0; node < tree.nodes.size(); ++node) places.push_back({node});
  const auto advice = advice_of(tree, places);
  REQUIRE(advice.size() == 1);
  CHECK(advice.front().severity == Severity::Note);
}

TEST_CASE("a node that is dead in one of its SubTrees only is not spoken of") {
  const Tree tree = tree_from_text("Sequence[memory=true](a Fallback(AlwaysSuccess b))");
  std::vector<Place> places;
  for (std::uint32_t node = 0; node < tree.nodes.size(); ++node) places.push_back({node});
  CHECK(advice_of(tree, places).size() == 1);
  places.back() = places[1];  // b is written where a is
  CHECK(advice_of(tree, places).empty());
}

TEST_CASE("of a tree with more states than the bound nothing is said") {
  std::string leaves;
  for (int i = 0; i < 12; ++i) leaves += " a" + std::to_string(i);
  const std::string parallel =
      "ParallelAbsolute[barriers=.1;.2;.3;.4;.5;.6;.7;.8](" + leaves.substr(1) + ')';
  CHECK(said_of("Sequence(" + parallel + " Inverter(AlwaysSuccess) z)").empty());
}

}  // namespace lockstep::host::test

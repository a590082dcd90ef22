// Each kind of finding on a small tree that has it, and on one like it that has not.
#include <algorithm>
#include <catch2/catch.hpp>

#include "verify/verified.h"

namespace lockstep::host::test {
namespace {

constexpr auto kEachFull = R"(<leaf path="*" finish="full"/>)";
constexpr auto kFullSuccess = R"(<leaf path="*" finish="full" result="success"/>)";

struct FindingsRow {
  std::string_view claim, tree, rows, findings;
};

// clang-format off
constexpr FindingsRow kFindingsRows[] = {
  {"a Sequence of two leaves has none", "Sequence[memory=true](a b)", "", ""},
  {"but without memory: the first leaf begins again in each tick, and may halt the second",
   "Sequence(a b)", "", "cycle"},
  {"a coarse barrier around a fine one: each holds what the other waits for",
   "Parallel(SyncProgress[barrier=coarse](SyncProgress[barrier=fine](a)) "
   "SyncProgress[barrier=coarse](Sequence[memory=true](b SyncProgress[barrier=fine](c)))) "
   "barrier[name=coarse barriers=.5] barrier[name=fine barriers=.25]", kFullSuccess, "trap"},
  {"not where the fine one comes before the coarse one",
   "Parallel(SyncProgress[barrier=coarse](SyncProgress[barrier=fine](a)) "
   "SyncProgress[barrier=coarse](Sequence[memory=true](SyncProgress[barrier=fine](b) c))) "
   "barrier[name=coarse barriers=.5] barrier[name=fine barriers=.25]", kFullSuccess, ""},
  {"keep at a barrier: the owner is held, and the other needs what it owns",
   "Parallel(UseResources[pool=p resources=A keep=true](SyncProgress[barrier=g](a)) "
   "SyncProgress[barrier=g](UseResources[pool=p resources=A](b))) barrier[name=g barriers=.5] "
   "resources[name=p]", kFullSuccess, "trap"},
  {"not without keep",
   "Parallel(UseResources[pool=p resources=A](SyncProgress[barrier=g](a)) "
   "SyncProgress[barrier=g](UseResources[pool=p resources=A](b))) barrier[name=g barriers=.5] "
   "resources[name=p]", kFullSuccess, ""},
  {"a member that need not run",
   "Parallel(SyncProgress[barrier=g](a) Fallback[memory=true](b SyncProgress[barrier=g](c))) "
   "barrier[name=g barriers=.5]", kEachFull, "trap"},
  {"not where the barrier leaves out who is idle",
   "Parallel(SyncProgress[barrier=g](a) Fallback[memory=true](b SyncProgress[barrier=g](c))) "
   "barrier[name=g barriers=.5 idle=ignore]", kEachFull, ""},
  {"a circle through a synchronized node",
   "Parallel(ParallelRelative[delta=.1](SyncProgress[barrier=g](a) "
   "Sequence[memory=true](b SyncProgress[barrier=h](c))) "
   "Sequence[memory=true](SyncProgress[barrier=h](d) SyncProgress[barrier=g](e))) "
   "barrier[name=g barriers=.5] barrier[name=h barriers=.5]",
   R"(<leaf path="*" finish="full" result="success" step="1"/>)",
   "trap, never-ticked/Main/Parallel/Sequence/SyncProgress#2"},
  {"a leaf is begun again and again", "Repeat(a)", R"(<leaf path="*" result="success"/>)", "trap"},
  {"also one that works for a while before it ends", "Repeat(a)", R"(<leaf path="*" ticks="3"/>)", "cycle"},
  {"but not one that need not end before the tree does", "Sequence[memory=true](a b)",
   R"(<leaf path="*" ticks="3..inf"/>)", ""},
  {"a condition that comes and goes halts an action again and again",
   "Fallback(Sequence(c? a) b)", R"(<leaf path="*" result="success"/><leaf path="*/c"
    result="success;failure"/><leaf path="*/b" ticks="2..inf"/>)", "cycle"},
  {"not where the condition does not change", "Fallback(Sequence(c? a) b)",
   R"(<fact name="f" changes="never"/><leaf path="*/c" fact="f"/><leaf path="*/a" result="success"/>)", ""},
  {"a leaf that need not end", "a", R"(<leaf path="*" ends="no"/>)", "cycle"},
  {"a tree that is to run for ever", "Repeat(a)",
   R"(<tree ends="no"/><leaf path="*" result="success"/>)", ""},
  {"a branch that never runs", "Fallback(AlwaysSuccess Sequence(a b))", "",
   "never-ticked/Main/Fallback/Sequence"},
  {"a fault that the leaf model allows", "Sequence[memory=true](a b)",
   R"(<leaf path="*/b" result="success;fault"/>)", "fault/Main/Sequence/b"},
  {"also below a node that goes on after a failure", "Fallback[memory=true](a b)",
   R"(<leaf path="*/a" result="failure" ticks="1"/><leaf path="*/b" result="fault" ticks="2"/>)",
   "fault/Main/Fallback/b"},
  {"also in the first tick", "Fallback(a b)", R"(<leaf path="*" result="fault" ticks="1"/>)",
   "never-ticked/Main/Fallback/b, fault/Main/Fallback/a"},
};
// clang-format on

}  // namespace

TEST_CASE("each kind of finding") {
  for (const FindingsRow& row : kFindingsRows) {
    INFO(row.claim);
    const Verified it(row.tree, row.rows);
    CHECK(it.found.is_complete());
    std::string wanted(row.findings);
    const std::string root = it.tree.id;
    for (auto at = wanted.find("Main"); at != std::string::npos; at = wanted.find("Main", at + 1)) {
      wanted.replace(at, 4, root);
    }
    CHECK(it.findings() == wanted);
  }
}

TEST_CASE("a trap says who waits for whom") {
  const Verified it(kFindingsRows[2].tree, kFindingsRows[2].rows);
  const Finding* trap = it.finding("trap");
  REQUIRE(trap != nullptr);
  REQUIRE_FALSE(trap->more.empty());
  INFO(trap->more.front());
  CHECK(trap->more.front().find("a deadlock: ") != std::string::npos);
  REQUIRE(trap->repeats);
  CHECK(trap->run.size() > *trap->repeats);
}

TEST_CASE("in an endless tree a child may be held indefinitely") {
  // Those who come first in the tree take the fork in turns.
  const auto table = [](std::string_view increment) {
    return "Parallel(Repeat(UseResources[pool=p resources=A](a)) "
           "Repeat(UseResources[pool=p resources=A](b)) "
           "Repeat(UseResources[pool=p resources=A](c))) resources[name=p increment=" +
           std::string(increment) + "]";
  };
  constexpr auto kRows2 = R"(<tree ends="no"/><leaf path="*" result="success" ticks="1..2"/>)";
  const Verified greedy(table("0"), kRows2);
  CHECK(greedy.findings().starts_with("starvation/"));
  CHECK(greedy.findings().ends_with("/c"));
  CHECK(Verified(table("1"), kRows2).findings().empty());
}

TEST_CASE("how long a child may be held") {
  const auto held = [](std::string_view rows) {
    const Verified it("ParallelAbsolute[barriers=.5](a b)", rows);
    for (const VerdictLine& line : it.verdict.facts) {
      if (line.name.starts_with("held: ") && line.name.ends_with("/a")) return line.text;
    }
    return std::string();
  };
  CHECK(held(R"(<leaf path="*" finish="full" ticks="1..4"/>)") == "at most 3 ticks");
  CHECK(held(R"(<leaf path="*" finish="full"/>)") == "as long as others take");
}

TEST_CASE("a Timeout that never fires, and one that may") {
  constexpr auto kName = "Timeouts that never fire";
  constexpr auto kTree = "Timeout[seconds=.5](a)";
  CHECK(Verified(kTree, R"(<leaf path="*" ticks="1..3"/>)").said(kName) != "");
  CHECK(Verified(kTree).said(kName).empty());
}

TEST_CASE("a property that is violated comes with what the last tick of its run does") {
  const Verified it("Parallel(a b)",
                    R"(<leaf path="*/a" ticks="5"/><leaf path="*/b" result="failure" ticks="2"/>)",
                    {}, 10, {"never a.running", "a.running leads to a.success"});
  REQUIRE(it.verdict.findings.size() == 2);
  CHECK(it.verdict.findings[0].more.at(0) ==
        "in tick 0: Test/Parallel/a runs, Test/Parallel/b runs");
  CHECK(it.verdict.findings[1].more.at(0) ==
        "in tick 1, in which the run ends: Test/Parallel/a is halted, Test/Parallel/b failed");
}

TEST_CASE("what is accepted and not found is said") {
  constexpr auto kAccepts = R"(<accept finding="never-ticked/*/a" because="not yet"/>
                               <accept finding="trap" because="it was there"/>)";
  const Verified it("Fallback(AlwaysSuccess a)", kAccepts);
  CHECK_FALSE(it.verdict.has_findings());
  CHECK(it.said("accepted, but not found") == "trap");
}

TEST_CASE("a finding may be accepted, with a reason") {
  const Verified it("Fallback(AlwaysSuccess a)",
                    R"(<accept finding="never-ticked/*" because="not yet"/>)");
  REQUIRE(it.verdict.findings.size() == 1);
  CHECK(it.verdict.findings[0].accepted == "not yet");
  CHECK_FALSE(it.verdict.has_findings());
}

TEST_CASE("the run to a finding is a shortest one") {
  const Verified it("Sequence[memory=true](a b)",
                    R"(<leaf path="*" result="success"/><leaf path="*/b" result="fault"/>)");
  const std::string name = it.findings();
  REQUIRE(name.starts_with("fault/"));
  CHECK(it.finding(name)->run.size() == 1);
  const std::string root = it.tree.id + "/Sequence/";
  CHECK(it.script(name) == root + "a = S\n" + root + "b = X\n");
}

TEST_CASE("a leaf that drifts while it is held") {
  // It falls back behind the barrier again and again: both wait for each other, and come on.
  const Verified it("ParallelAbsolute[barriers=.5](a b)",
                    R"(<leaf path="*" finish="full" result="success" held="-1..0"/>)",
                    {.symmetry = false});
  CHECK(it.found.is_complete());
  CHECK(it.found.store.size() > 9);
}

TEST_CASE("a trap names the conditions that are false for ever, and the entries that they read") {
  const Verified it(
      "Sequence[memory=true](Script[code=open:=false] "
      "Repeat(Inverter(Sequence(Check[code=open] AlwaysSuccess))) a[skip_if=open])");
  REQUIRE(it.finding("trap") != nullptr);
  const auto& more = it.finding("trap")->more;
  const auto line = std::ranges::find_if(
      more, [](const std::string& text) { return text.starts_with("always false: "); });
  REQUIRE(line != more.end());
  CHECK(line->ends_with("Check, which reads {open} (false)"));
  // Not one that a leaf may still make true.
  const Verified other(
      "Sequence[memory=true](Script[code=open:=false] Parallel(Repeat(Inverter(Check[code=open])) "
      "Repeat(Inverter(a[on_success=open=true]))))",
      R"(<tree ends="yes"/>)");
  if (const Finding* trap = other.finding("trap")) {
    for (const std::string& text : trap->more) CHECK_FALSE(text.starts_with("always false: "));
  }
}

}  // namespace lockstep::host::test

// Properties of all behaviors: what is violated, by a shortest run, and what holds.
#include <catch2/catch.hpp>

#include "verify/verified.h"

namespace lockstep::host::test {
namespace {

struct PropertyRow {
  std::string_view property, tree, rows, verdict;  // "holds", or the ticks to the violation
};

constexpr auto kArms = "ParallelAbsolute[barriers=.5](a b)";
constexpr auto kWaits =
    "Sequence[memory=true](Script[code=q:=1.0] ParallelAbsolute[barriers=.5](Wait[seconds={q}] a))";
constexpr auto kFull = R"(<leaf path="*" finish="full" result="success"/>)";

// clang-format off
const PropertyRow kPropertyRows[] = {
  {"never b.running", "Sequence[memory=true](a b)", "", "1"},
  {"never b.running", "Sequence[memory=true](a b)", R"(<leaf path="*/a" result="failure"/>)", "holds"},
  {"never b.success and a.idle", "Sequence[memory=true](a b)", "", "holds"},
  {"never a.failure and b.ticked", "Sequence[memory=true](a b)", "", "holds"},
  // In one tick a leaf may come past the barrier, but not from it on.
  {"never a.progress > 0.5 and b.progress < 0.5 and b.running", kArms, kFull, "2"},
  {"never a.progress > 0.5 and b.progress < 0.5 and b.running", kArms,
   R"(<leaf path="*" finish="full" step="0..1"/>)", "holds"},
  {"never a.progress >= 0.5 and b.progress < 0.5 and b.running", kArms, kFull, "2"},
  {"b.running only after a.success", "Sequence[memory=true](a b)", "", "holds"},
  {"b.running only after a.success", "Parallel(a b)", "", "1"},
  {"after a.success never a.ticked", "Sequence[memory=true](a b)", "", "holds"},
  {"after a.success never a.ticked", "Retry[attempts=3](Sequence[memory=true](a b))", "", "2"},
  {"after a.success never b.failure", "Retry[attempts=3](Sequence[memory=true](a b))",
   R"(<leaf path="*/b" ticks="1"/>)", "2"},
  {"after a.failure never b.running", "Sequence[memory=true](a b)", "", "holds"},
  {"a.held at most 2 ticks", kArms, R"(<leaf path="*" finish="full" ticks="1..3"/>)", "holds"},
  {"a.held at most 1 ticks", kArms, R"(<leaf path="*" finish="full" ticks="1..4"/>)", "3"},
  {"sometimes b.success", "Fallback[memory=true](a b)", "", "1"},
  {"sometimes a.success or a.failure", "a", "", "holds"},
  {"a.running leads to a.done", "a", "", "holds"},
  {"a.running leads to a.done within 2 ticks", "a", R"(<leaf path="*" ticks="1..3"/>)", "holds"},
  {"a.running leads to a.done within 1 ticks", "a", R"(<leaf path="*" ticks="1..3"/>)", "2"},
  // Behind 0 is another place than at 0, and between a constant and a barrier one than at the barrier.
  {"never a.progress > 0", "Inverter(a)", "", "2"},
  {"never not (Inverter.progress == 0)", "Inverter(a)", "", "2"},
  {"never Inverter.progress > 0.5 and b.held", "Inverter(ParallelAbsolute[barriers=.75](a b))", "", "2"},
  {"never Repeat.progress > 0.5 and b.held", "Repeat[times=2](ParallelAbsolute[barriers=.5](a b))", "", "3"},
  // What a property compares progress with makes no step smaller: of a grid, or from cut to cut.
  {"never b.progress > 0.6 and a.running", "Parallel(a b)",
   R"(<leaf path="*/a" result="success" ticks="5" progress="none"/>
      <leaf path="*/b" result="success" progress="grid:4" step="1" finish="full"/>)", "4"},
  {"b.progress >= 0.5 only after b.progress >= 0.2 and b.progress < 0.5", kArms,
   R"(<leaf path="*" finish="full" step="0..1"/>)", "2"},
  // A run, which does not know the property, stays at the last level of the tree.
  {"never a.idle and a.progress == 0", "Timeout[seconds=0.1](a)", R"(<leaf path="*/a" step="1..2"/>)", "2"},
  {"never a.progress > 0.2 and a.progress < 0.7 and a.ticked and b.progress > 0.7", kArms,
   R"(<leaf path="*" finish="full" step="1" result="success" ticks="4"/>)", "3"},
  // The progress of a node needs the parameters that it has read, also before it reads them again.
  // A hold of the tick before is none of a tick that then reaches the node.
  {"ForceSuccess.held at most 1 ticks", "ParallelAbsolute[failure_count=1 barriers=1](Parallel[success_count=2 "
   "memory=false](a WhileDoElse(Wait[seconds=.1] Wait[seconds=.1]) Rate[seconds=.2](Wait[seconds=.1])) "
   "ForceSuccess(Wait[seconds=.1]))", "", "holds"},
  {"never Wait.held", kWaits, R"(<leaf path="*/a" result="success" ticks="3" progress="none"/>)", "holds"},
  {"a.success only after Wait.held", kWaits,
   R"(<leaf path="*/a" result="success" ticks="3" progress="none"/>)", "3"},
  // Below a node that has ended, results stay as they are.
  {"never a.success and c.running", "Sequence[memory=true](Sequence[memory=true](a b) c)", "", "1"},
};
// clang-format on

std::string verdict_of(const Verified& it) {
  const std::string& name = it.properties[0].name();
  const Finding* finding = it.finding("property/" + name);
  return finding == nullptr ? it.said("property '" + name + "'")
                            : std::to_string(finding->run.size());
}

}  // namespace

TEST_CASE("properties of all behaviors") {
  for (const PropertyRow& row : kPropertyRows) {
    INFO(row.property << " of " << row.tree << ' ' << row.rows);
    CHECK(verdict_of(Verified(row.tree, row.rows, {}, 10, {std::string(row.property)})) ==
          row.verdict);
  }
}

TEST_CASE("a property that waits is violated by a run that goes on without it") {
  constexpr auto kEndless = R"(<tree ends="no"/><leaf path="*" result="success"/>)";
  const auto findings = [&](std::string property) {
    return Verified("Repeat(Fallback[memory=true](Inverter(c?) a))", kEndless, {}, 10,
                    {std::move(property)})
        .findings();
  };
  CHECK(findings("it: sometimes a.failure") == "property/it");
  CHECK(findings("it: sometimes a.success").empty());
}

TEST_CASE("the run of each finding begins as a run does") {
  const Verified it("Parallel(a b)", "", {}, 10, {"x: never a.running", "y: never b.success"});
  CHECK(it.findings() == "property/x, property/y");
  CHECK(it.script("property/y") == "Test/Parallel/a = S\nTest/Parallel/b = S\n");
}

TEST_CASE("one property that is violated does not hide another") {
  const Verified it("Sequence[memory=true](a b)", "", {}, 10,
                    {"x: never a.ticked", "y: never b.ticked"});
  CHECK(it.findings() == "property/x, property/y");
}

TEST_CASE("a leaf may write its outputs while it runs, and with a failure") {
  constexpr auto kTree =
      "Sequence[memory=true](Script[code=s:=false] Parallel[success_count=1](look[flag={s}] "
      "Sequence[memory=true](WaitUntil[code=s] AlwaysSuccess)))";
  const std::vector<std::string> only{"q: 'AlwaysSuccess'.success only after look.done"};
  CHECK(Verified(kTree, "", {}, 10, only).findings() == "property/q");
  CHECK(Verified(kTree, R"(<leaf path="*/look" writes="any"/>)", {}, 10, only).findings() ==
        "property/q");
  CHECK(Verified(kTree, R"(<leaf path="*/look" writes="success"/>)", {}, 10, only)
            .findings()
            .empty());
  constexpr auto kSensor =
      "Sequence[memory=true](Script[code=s:=true] Fallback(look[flag={s}]? "
      "Sequence(Check[code=!s] AlwaysSuccess)))";
  const Verified sensor(kSensor);
  CHECK(sensor.said("never ticked") == "none");
  CHECK(sensor.verdict.assumed.back() ==
        "no leaf without writes=\"…\" in the leaf model writes outside of its ticks, or succeeds "
        "before its outputs have values (1 leaf)");
}

TEST_CASE("an output that nothing has given a value has one when its leaf succeeds") {
  constexpr auto kTree = "Sequence[memory=true](look[flag={s}] Check[code=s])";
  CHECK(Verified(kTree).findings().empty());
  CHECK(Verified("Sequence[memory=true](ForceSuccess(look[flag={s}]) Check[code=s])").findings() ==
        "fault/Test/Sequence/Check");
}

TEST_CASE("a property may name a fact of the leaf file") {
  constexpr auto kPropertyRows =
      R"(<fact name="charged" changes="never"/><leaf path="*/c" fact="charged"/>
    <leaf path="*/a" result="success" sets="charged=true"/>)";
  const Verified it("Sequence[memory=true](Fallback[memory=true](c? a) b)", kPropertyRows, {}, 10,
                    {"never b.running and {fact:charged} != true", "never {fact:charged} == false",
                     "{fact:charged} == true only after c.ticked"});
  CHECK(it.findings() == "property/never {fact:charged} == false");
  CHECK_THROWS(Verified("a", "", {}, 10, {"never {fact:charged} == true"}));
}

}  // namespace lockstep::host::test

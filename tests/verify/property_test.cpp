// Properties of all behaviors: what is violated, by a shortest run, and what holds.
#include <catch2/catch.hpp>

#include "verify/verified.h"

namespace lockstep::host::test {
namespace {

struct Row {
  std::string_view property, tree, rows, verdict;  // "holds", or the ticks to the violation
};

constexpr auto kArms = "ParallelAbsolute[barriers=.5](a b)";
constexpr auto kFull = R"(<leaf path="*" finish="full" result="success"/>)";

// clang-format off
const Row kRows[] = {
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
  {"a.held at most 2 ticks", kArms, R"(<leaf path="*" finish="full" ticks="1..3"/>)", "holds"},
  {"a.held at most 1 ticks", kArms, R"(<leaf path="*" finish="full" ticks="1..4"/>)", "3"},
  {"sometimes b.success", "Fallback[memory=true](a b)", "", "1"},
  {"sometimes a.success or a.failure", "a", "", "holds"},
  {"a.running leads to a.done", "a", "", "holds"},
  {"a.running leads to a.done within 2 ticks", "a", R"(<leaf path="*" ticks="1..3"/>)", "holds"},
  {"a.running leads to a.done within 1 ticks", "a", R"(<leaf path="*" ticks="1..3"/>)", "2"},
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
  for (const Row& row : kRows) {
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

TEST_CASE("one property that is violated does not hide another") {
  const Verified it("Sequence[memory=true](a b)", "", {}, 10,
                    {"x: never a.ticked", "y: never b.ticked"});
  CHECK(it.findings() == "property/x, property/y");
}

}  // namespace lockstep::host::test

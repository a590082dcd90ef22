// A search that counts states of equal children once says what a search says that does not: on
// random trees, and on trees where it matters who is who. Runs to findings are checked tick by
// tick.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <regex>

#include "support/trials.h"
#include "verify/verified.h"

namespace lockstep::host::test {
namespace {

// Few kinds and many equal subtrees, so that most trees have parallels with equal children.
class RandomTree {
 public:
  explicit RandomTree(std::uint64_t seed) : random_(seed) {}

  std::string text() {
    const std::string tree = node(chance(4) ? 3 : 2);
    return chance(4) ? below_read_entry(tree) : tree;
  }
  std::string rows(const std::string& tree) {
    static const std::vector<std::string> kResults{"success", "success;failure", "success;skipped"};
    const bool has_delta = tree.find("delta") != std::string::npos;
    std::string rows = one_of({"", "<tree ends=\"no\"/>", ""});
    rows += "<leaf path=\"*\" result=\"" + one_of(kResults) + "\" ticks=\"" +
            one_of({"1..2", "1..inf", "1..3"}) + "\" finish=\"" + one_of({"full", "any"}) +
            "\" progress=\"" + (has_delta ? "grid:4" : one_of({"cuts", "grid:4"})) +
            "\" step=\"0..1\" held=\"" + one_of({"still", "still", "-1..0"}) + "\"/>";
    static const std::regex kA("\\ba\\b");
    const bool has_a = std::regex_search(tree, kA);
    if (has_a && chance(3)) rows += "<leaf path=\"*/a*\" ticks=\"2\"/>";
    return rows;
  }

 private:
  bool chance(unsigned of) { return random_() % of == 0; }
  std::string one_of(const std::vector<std::string>& words) {
    return words[random_() % words.size()];
  }

  // While the tree runs, a node around it has read something else than the entry now has.
  static std::string below_read_entry(const std::string& tree) {
    return "Sequence[memory=true](Script[code=t:=0.3] Timeout[seconds={t}](Sequence[memory=true]("
           "Script[code=t=0.4] " +
           tree + ")))";
  }

  std::string node(int depth) {
    if (depth == 0) return one_of({"a", "a", "b", "b", "c?"});
    switch (random_() % 8) {
      case 0:
        return one_of({"Inverter", "ForceSuccess", "Timeout[seconds=.2]", "Repeat",
                       "Repeat[times=2]", "Retry[attempts=2]"}) +
               '(' + node(depth - 1) + ')';
      case 1:
        return one_of({"Sequence", "Sequence[memory=true]", "Fallback"}) + '(' + node(depth - 1) +
               ' ' + node(depth - 1) + ')';
      case 2:
        return one_of({"a", "b"});
      default:
        return parallel(depth);
    }
  }

  std::string parallel(int depth) {
    std::string text = one_of({"Parallel", "Parallel[success_count=1]", "Parallel[memory=false]",
                               "ParallelAbsolute[barriers=.5]", "ParallelAbsolute[barriers=.25;.5]",
                               "ParallelRelative[delta=.25]", "ParallelRelative[delta=0]"}) +
                       '(';
    const std::string child = node(depth - 1);
    const std::size_t equal = 2 + random_() % 2;
    for (std::size_t i = 0; i < equal; ++i) text += (i > 0 ? " " : "") + child;
    if (chance(3)) text.insert(text.size() - child.size(), node(depth - 1) + ' ');
    return text + ')';
  }

  std::mt19937_64 random_;
};

// Equal leaves under one parallel, each by itself or in a child that has no other, and who else may
// decide when it ends.
class RandomLeaves {
 public:
  explicit RandomLeaves(std::uint64_t seed) : random_(seed) {}

  std::string text() {
    const std::string around =
        one_of({"", "", "Retry[attempts=2]", "Repeat[times=2]", "Inverter", "Timeout[seconds=.2]",
                "Delay[seconds=.1]", "Repeat", "Retry[attempts=2]", "Timeout[seconds=.2]Repeat"});
    static const std::vector<std::string> kSubtrees{"Sequence[memory=true](a b)",
                                                    "Fallback[memory=true](a a)",
                                                    "Sequence(c? a)",
                                                    "ParallelAbsolute[barriers=.5](a a)",
                                                    "Parallel[success_count=1](a b)",
                                                    "Retry[attempts=2](Sequence[memory=true](a b))",
                                                    "ParallelRelative[delta=.25](Inverter(a) b)",
                                                    "Sequence[memory=true](a Parallel(a a))"};
    const bool has_many = random_() % 2 == 0;
    const std::string leaf = has_many ? one_of(kSubtrees) : child(around);
    const std::string leaves = leaf + ' ' + leaf + one_of({"", "", ' ' + leaf});
    const std::string parallel =
        one_of({"Parallel", "Parallel[success_count=1]", "Parallel[memory=false]",
                "ParallelAbsolute[barriers=.5]", "ParallelAbsolute[barriers=.25;.75]",
                "ParallelRelative[delta=0]", "ParallelRelative[delta=.25]",
                "ParallelRelative[delta=.5]"}) +
        '(' + one_of({leaves, leaves, leaves + " Repeat(d)", leaves + " d"}) + ')';
    return one_of({"Repeat(" + parallel + ')', "Repeat(ForceSuccess(" + parallel + "))", parallel,
                   "Fallback(Sequence(c? " + parallel + ") d)",
                   "Repeat(Timeout[seconds=.3](" + parallel + "))",
                   "Parallel(Repeat(" + parallel + ") d)", "Retry[attempts=2](" + parallel + ')'});
  }
  std::string rows() {
    const std::string held = one_of({"still", "-1..0", "-4..0", "-1..1", "0..1"});
    return one_of({"<tree ends=\"no\"/>", ""}) + "<leaf path=\"*\" result=\"" +
           one_of({"success", "success;failure", "success;skipped", "failure"}) + "\" ticks=\"" +
           one_of({"1..2", "1..inf", "2..inf", "1..3"}) + "\" finish=\"" + one_of({"full", "any"}) +
           "\" progress=\"grid:4\" step=\"" + one_of({"0..1", "-1..1", "1..2", "0..inf"}) +
           "\" held=\"" + held + "\"/>";
  }

 private:
  // A leaf in these decorators, each with its attributes.
  static std::string child(const std::string& around) {
    if (around.empty()) return "a";
    const std::size_t inner = around.find(']');
    if (inner == std::string::npos || inner + 1 == around.size()) return around + "(a)";
    return around.substr(0, inner + 1) + '(' + child(around.substr(inner + 1)) + ')';
  }
  std::string one_of(const std::vector<std::string>& words) {
    return words[random_() % words.size()];
  }
  std::mt19937_64 random_;
};

// The run is one of the tree: each tick begins where the one before it ended; a cycle comes back to
// where it began, and is fair unless it is in a trap. A child that starves is held in all of it.
void check_run(const Verified& it, const Finding& finding) {
  INFO(finding.name);
  Tracer tracer(it.tree, it.models, it.properties, it.rate, it.found);
  const TracedRun& run = finding.run;
  const std::size_t round = finding.repeats ? (run.size() - *finding.repeats) / 2 : 0;
  std::vector<bool> works(it.tree.leaves.size()), ends(works.size());
  StateBytes after;
  tracer.play(run, [&](Stepper& stepper, Status status, std::size_t tick) {
    if (tick > 0) CHECK(run[tick].before == after);
    const bool is_in_cycle = finding.repeats && tick >= *finding.repeats;
    if (is_in_cycle) {
      CHECK(status == Status::Running);
      for (std::size_t leaf = 0; leaf < works.size(); ++leaf) {
        const LeafMark& mark = stepper.leaves().marks()[leaf];
        if (mark.ended) ends[leaf] = true;
        if (mark.ticked && !mark.ended) works[leaf] = true;
      }
      if (finding.name.starts_with("starvation/")) CHECK(stepper.ticker().held(*finding.node));
    }
    stepper.fold();
    after = stepper.in_place();
  });
  if (!finding.repeats) return;
  REQUIRE(round > 0);
  CHECK(run[*finding.repeats].before == after);
  CHECK(run[*finding.repeats].before == run[*finding.repeats + round].before);
  if (finding.name == "trap") return;
  for (std::size_t leaf = 0; leaf < works.size(); ++leaf) CHECK((!works[leaf] || ends[leaf]));
}

// One order of answers finds the states that all orders find, and each as early.
void check_same_states(const Verified& one, const Verified& all) {
  const SearchResult &a = one.found, &b = all.found;
  REQUIRE(a.store.size() == b.store.size());
  CHECK(a.depths == b.depths);
  // Of ticks that come to the same point more are followed where answers have one order.
  if (a.few_ticks == kAllTicks) CHECK(a.transitions <= b.transitions);
  for (StateId id = 0; id < a.store.size(); ++id) {
    const StateId same = b.store.find(a.store[id], hash_of(a.store[id]));
    if (same == kNoState || a.depth_of(id) != b.depth_of(same)) FAIL("state " << id);
  }
}

}  // namespace

TEST_CASE("equal children: random trees have the same verdict with and without symmetry",
          "[trials]") {
  const std::uint64_t trees = trials(400);
  std::size_t compared = 0, smaller = 0, fewer = 0, cycles = 0, starving = 0;
  for (std::uint64_t seed = 0; seed < trees; ++seed) {
    RandomTree random(seed);
    const std::string tree = random.text(), rows = random.rows(tree);
    INFO("seed " << seed << ": " << tree << ' ' << rows);
    SearchLimits limits{.states = 1500, .transitions = 15'000, .symmetry = false};
    limits.few_ticks = seed % 2 == 0 ? kAllTicks : 0;
    const Verified plain(tree, rows, limits);
    if (!plain.found.is_complete()) continue;
    limits.symmetry = true;
    limits.transitions = 150'000;  // where answers have one order, ticks share fewer points
    const Verified folded(tree, rows, limits);
    limits.rising_answers = false;
    const Verified all_orders(tree, rows, limits);
    ++compared;
    smaller += folded.found.store.size() < plain.found.store.size();
    CHECK(folded.found.is_complete());
    CHECK(folded.found.store.size() <= plain.found.store.size());
    CHECK(said_by(folded) == said_by(plain));
    CHECK(said_by(all_orders) == said_by(plain));
    check_same_states(folded, all_orders);
    fewer += folded.found.transitions < all_orders.found.transitions;
    for (const Verified* it : {&plain, &folded, &all_orders}) {
      for (const Finding& finding : it->verdict.findings) {
        cycles += finding.name == "cycle";
        starving += finding.name.starts_with("starvation/");
        check_run(*it, finding);
      }
    }
  }
  INFO(compared << " compared, " << smaller << " smaller, " << cycles << " cycles, " << starving);
  CHECK(compared > trees / 2);
  CHECK(smaller > trees / 5);
  CHECK(fewer > trees / 10);
  CHECK(cycles > trees / 40);
  CHECK(starving > trees / 40);
}

TEST_CASE("equal leaves: one order of their answers has the verdict that each child counted has",
          "[trials]") {
  const std::uint64_t trees = trials(125);
  std::size_t compared = 0, fewer = 0;
  for (std::uint64_t seed = 0; seed < trees; ++seed) {
    RandomLeaves random(seed);
    const std::string tree = random.text(), rows = random.rows();
    INFO("seed " << seed << ": " << tree << ' ' << rows);
    SearchLimits limits{.states = 1500, .transitions = 15'000, .symmetry = false};
    limits.few_ticks = seed % 2 == 0 ? kAllTicks : 0;
    const Verified plain(tree, rows, limits);
    if (!plain.found.is_complete()) continue;
    limits.symmetry = true;
    limits.transitions = 150'000;  // where answers have one order, ticks share fewer points
    const Verified folded(tree, rows, limits);
    limits.rising_answers = false;
    const Verified all_orders(tree, rows, limits);
    ++compared;
    CHECK(said_by(folded) == said_by(plain));
    check_same_states(folded, all_orders);
    fewer += folded.found.transitions < all_orders.found.transitions;
    for (const Finding& finding : folded.verdict.findings) check_run(folded, finding);
  }
  CHECK(compared > trees / 2);
  CHECK(fewer > trees / 3);
}

// clang-format off
struct SymmetryRow {
  std::string_view claim, tree, rows, property;
  bool is_smaller;
};
constexpr SymmetryRow kSymmetryRows[] = {
  {"plain leaves", "ParallelAbsolute[barriers=.5](a b)", "", "", true},
  {"not where a row makes them different", "ParallelAbsolute[barriers=.5](a b)",
   R"(<leaf path="*/b" ticks="2"/>)", "", false},
  {"not where a property names one", "ParallelAbsolute[barriers=.5](a b)", "",
   "never a.success and b.running", false},
  {"but those that it does not name", "ParallelAbsolute[barriers=.5](a b d)", "",
   "never a.success and a.failure", true},
  {"a property of the parent names none", "ParallelAbsolute[barriers=.5](a b)", "",
   "never ParallelAbsolute.success and ParallelAbsolute.running", true},
  {"the first of two that set a fact is asked before the second",
   "Parallel[success_count=1](Sequence(c? a) Sequence(d? b))",
   R"(<fact name="f" changes="never"/><leaf path="*/c" fact="f"/><leaf path="*/d" fact="f"/>
   <leaf path="*/a" sets="f=false" result="success"/><leaf path="*/b" sets="f=false" result="success"/>)",
   "", false},
  {"a fact that none of them sets is the same for all",
   "Parallel[failure_count=2](Sequence(c? a) Sequence(d? b))",
   R"(<fact name="f" changes="rises"/><leaf path="*/c" fact="f"/><leaf path="*/d" fact="f"/>)", "", true},
  {"the second gets no tick where the first has a fault", "Parallel(a b)",
   R"(<leaf path="*" result="fault" ticks="1..1"/>)", "", false},
  {"nor where one between them has", "Parallel(a AlwaysRunning f b)",
   R"(<leaf path="*/f" result="fault" ticks="1..1"/>)", "", false},
  {"the first member of a pool comes first",
   "Parallel(Repeat(UseResources[pool=p resources=A](a)) Repeat(UseResources[pool=p resources=A](b))) "
   "resources[name=p increment=0]", R"(<tree ends="no"/><leaf path="*" result="success" ticks="1..2"/>)", "", false},
  {"a barrier remembers its members by their numbers",
   "Parallel(SyncProgress[barrier=g](a) SyncProgress[barrier=g](b)) barrier[name=g barriers=.5]", "", "", false},
  {"the last script that writes decides", "Parallel(Script[code=n:=1] Script[code=n:=1] a)", "", "", false},
  {"a Sequence is at a child of its own place",
   "Parallel(Sequence[memory=true](a b) Sequence[memory=true](a b) Sequence[memory=true](a b))", "", "", true},
  {"times are equal where they passed equally", "Parallel(Timeout[seconds=.3](a) Timeout[seconds=.3](b))", "", "", true},
  {"not with another time", "Parallel(Timeout[seconds=.3](a) Timeout[seconds=.2](b))", "", "", false},
  {"one inside of the other",
   "Parallel(ParallelAbsolute[barriers=.5](a b) ParallelAbsolute[barriers=.5](a b))", "", "", true},
  {"each may starve, and is shown", "ParallelAbsolute[barriers=.5](a b d)",
   R"(<tree ends="no"/><leaf path="*" result="success;skipped"/>)", "", true},
  {"one works for ever while the other ends again and again", "Parallel(Repeat(a) Repeat(b))",
   R"(<leaf path="*" result="success" ticks="1..2"/>)", "", true},
  {"a property that waits", "Fallback(Parallel(Repeat(a) Repeat(b)) d)",
   R"(<leaf path="*" result="success"/>)", "sometimes d.success", true},
};
// clang-format on

TEST_CASE("equal children: only those that nobody can tell apart") {
  for (const SymmetryRow& row : kSymmetryRows) {
    INFO(row.claim << ": " << row.tree << ' ' << row.rows);
    std::vector<std::string> properties;
    if (!row.property.empty()) properties.emplace_back(row.property);
    const Verified plain(row.tree, row.rows, {.symmetry = false}, 10, properties);
    const Verified folded(row.tree, row.rows, {}, 10, properties);
    const Verified threads(row.tree, row.rows, {.jobs = 2}, 10, properties);
    CHECK(plain.found.is_complete());
    CHECK(said_by(folded) == said_by(plain));
    CHECK((folded.found.store.size() < plain.found.store.size()) == row.is_smaller);
    CHECK(folded.found.symmetry.empty() != row.is_smaller);
    CHECK(said_by(threads) == said_by(folded));
    CHECK(threads.found.store.size() == folded.found.store.size());
    for (const Finding& finding : folded.verdict.findings) check_run(folded, finding);
  }
}

TEST_CASE("equal children: they change places below a node that has read another value") {
  const std::string tree =
      "Sequence[memory=true](Script[code=t:=0.3] Timeout[seconds={t}](Sequence[memory=true]("
      "Script[code=t=0.4] Parallel(a a))))";
  const Verified plain(tree, "", {.symmetry = false}), folded(tree, "");
  CHECK(said_by(folded) == said_by(plain));
  CHECK(folded.found.store.size() < plain.found.store.size());
}

TEST_CASE("equal children: forty leaves in equal states give their answers in one order") {
  std::string leaves = "a";
  for (int i = 1; i < 40; ++i) leaves += " a";
  const Verified it("ParallelAbsolute[barriers=.5](" + leaves + ')',
                    R"(<leaf path="*" finish="full" result="success"/>)");
  CHECK(it.found.is_complete());
  // So many are ahead of the barrier, at it, or have succeeded.
  CHECK(it.found.store.size() == 42 * 41 / 2);
  CHECK(it.findings() == "");
  CHECK(it.said("always ends") == "yes");
  CHECK(it.said("results") == "success (from 1 tick)");
}

TEST_CASE("equal children: forty with one leaf each give their answers in one order") {
  std::string children = "Retry[attempts=2](a)";
  for (int i = 1; i < 40; ++i) children += " Retry[attempts=2](a)";
  const Verified it("Parallel(" + children + ')', R"(<leaf path="*" ticks="2"/>)");
  CHECK(it.found.is_complete());
  CHECK(it.findings() == "");
  CHECK(it.said("always ends") == "yes");
  CHECK(it.said("results") == "success (from 2 ticks), failure (from 4 ticks)");
}

TEST_CASE("equal children: twenty with two leaves each give their answers in one order") {
  std::string children = "Sequence[memory=true](a b)";
  for (int i = 1; i < 20; ++i) children += " Sequence[memory=true](a b)";
  const Verified it("Parallel(" + children + ')', R"(<leaf path="*" result="success"/>)");
  CHECK(it.found.is_complete());
  // So many are at their first leaf, at their second one, or have succeeded; and before the start.
  CHECK(it.found.store.size() == 22 * 21 / 2);
  CHECK(it.findings() == "");
  CHECK(it.said("always ends") == "yes");
  CHECK(it.said("results") == "success (from 1 tick)");
}

TEST_CASE("equal children: answers of those with several leaves are in the order of words") {
  // From the state in which both children are at their first leaf: none, one or both of the two go
  // on, and then each may have done so by now or not.
  const std::string rows = R"(<leaf path="*" result="success"/>)";
  const std::string tree = "Parallel(Sequence[memory=true](a b) Sequence[memory=true](a b))";
  const Verified one(tree, rows), all(tree, rows, {.rising_answers = false});
  check_same_states(one, all);
  // Each child has three answers where both are at `a` (also before the start) and two where both
  // are at `b`; where one is at each, or one is over, all of its answers count.
  CHECK(one.found.transitions == 2 * 6 + 3 + 3 * 2 + 3 + 2);
  CHECK(all.found.transitions == 2 * 9 + 4 + 3 * 2 + 3 + 2);
}

TEST_CASE("equal children: a child that starves is the one that the finding names") {
  const Verified it("ParallelAbsolute[barriers=.5](a b d)",
                    R"(<tree ends="no"/><leaf path="*" result="success;skipped"/>)");
  const std::string root = it.tree.id + "/ParallelAbsolute/";
  for (const std::string child : {"a", "b", "d"}) {
    INFO(child);
    const Finding* finding = it.finding("starvation/" + root + child);
    REQUIRE(finding != nullptr);
    check_run(it, *finding);
  }
}

}  // namespace lockstep::host::test

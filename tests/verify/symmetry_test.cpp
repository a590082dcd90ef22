// A search that counts states of equal children once says what a search says that does not: on
// random trees, and on trees where it matters who is who. Runs to findings are checked tick by
// tick.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <regex>

#include "verify/verified.h"

namespace lockstep::host::test {
namespace {

// Few kinds and many equal subtrees, so that most trees have parallels with equal children.
class RandomTree {
 public:
  explicit RandomTree(std::uint64_t seed) : random_(seed) {}

  std::string text() { return node(chance(4) ? 3 : 2); }
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

// What must be the same: a cycle may have another length.
std::string said_by(const Verified& it) {
  std::string said = it.findings() + '\n';
  for (const VerdictLine& line : it.verdict.facts) {
    if (line.name != "alike") said += line.name + ": " + line.text + '\n';
  }
  static const std::regex kLength("cycle of [0-9]+ ticks?");
  return std::regex_replace(said, kLength, "cycle");
}

// The run is one of the tree: each tick begins where the one before it ended; a cycle comes back to
// where it began, and is fair unless it is in a trap. A child that starves is held in all of it.
void check_run(const Verified& it, const Finding& finding) {
  INFO(finding.name);
  Tracer tracer(it.tree, it.models, it.properties, from_seconds(1 / it.rate), it.found);
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

}  // namespace

TEST_CASE("equal children: random trees have the same verdict with and without symmetry") {
  constexpr std::uint64_t kTrees = 400;
  std::size_t compared = 0, smaller = 0, cycles = 0, starving = 0;
  for (std::uint64_t seed = 0; seed < kTrees; ++seed) {
    RandomTree random(seed);
    const std::string tree = random.text(), rows = random.rows(tree);
    INFO("seed " << seed << ": " << tree << ' ' << rows);
    SearchLimits limits{.states = 1500, .transitions = 15'000, .symmetry = false};
    const Verified plain(tree, rows, limits);
    if (!plain.found.is_complete()) continue;
    limits.symmetry = true;
    const Verified folded(tree, rows, limits);
    ++compared;
    smaller += folded.found.store.size() < plain.found.store.size();
    CHECK(folded.found.is_complete());
    CHECK(folded.found.store.size() <= plain.found.store.size());
    CHECK(said_by(folded) == said_by(plain));
    for (const Verified* it : {&plain, &folded}) {
      for (const Finding& finding : it->verdict.findings) {
        cycles += finding.name == "cycle";
        starving += finding.name.starts_with("starvation/");
        check_run(*it, finding);
      }
    }
  }
  INFO(compared << " compared, " << smaller << " smaller, " << cycles << " cycles, " << starving);
  CHECK(compared > kTrees / 2);
  CHECK(smaller > kTrees / 5);
  CHECK(cycles > 10);
  CHECK(starving > 10);
}

// clang-format off
struct Row {
  std::string_view claim, tree, rows, property;
  bool is_smaller;
};
constexpr Row kRows[] = {
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
  for (const Row& row : kRows) {
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

// How many states and transitions small trees have, and what ends a search.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "dialect/btcpp/rules.h"
#include "verify/verified.h"

namespace lockstep::host::test {
namespace {

// A ParallelAbsolute of n leaves and k barriers, i / (k + 1).
std::string absolute(int n, int k) {
  std::string barriers, leaves;
  for (int i = 1; i <= k; ++i) {
    barriers += (i > 1 ? ";" : "") + std::to_string(static_cast<double>(i) / (k + 1));
  }
  for (int i = 0; i < n; ++i) leaves += " a" + std::to_string(i);
  return "ParallelAbsolute[barriers=" + barriers + "](" + leaves.substr(1) + ")";
}

}  // namespace

std::size_t choose(std::size_t n, std::size_t k) {
  return k == 0 ? 1 : choose(n - 1, k - 1) * n / k;
}

TEST_CASE("a ParallelAbsolute has a state for each region of each leaf, or for each number in it") {
  for (const auto& [n, k] : {std::pair(2, 1), {2, 4}, {2, 8}, {3, 4}, {3, 8}, {4, 4}, {5, 4}}) {
    INFO(n << " leaves, " << k << " barriers");
    constexpr auto kFull = R"(<leaf path="*" finish="full"/>)";
    const Verified each(absolute(n, k), kFull, {.symmetry = false}), once(absolute(n, k), kFull);
    CHECK(each.found.is_complete());
    CHECK(each.found.store.size() == static_cast<std::size_t>(std::pow(k + 2, n)));
    CHECK(once.found.is_complete());
    CHECK(once.found.store.size() ==
          choose(static_cast<std::size_t>(n + k + 1), static_cast<std::size_t>(n)));
  }
}

TEST_CASE("each answer of a leaf is tried") {
  // Running, success or failure.
  const Verified it("a");
  CHECK(it.found.store.size() == 2);  // before the first tick, and running
  CHECK(it.found.transitions == 6);
  CHECK(it.said("results") == "success (from 1 tick), failure (from 1 tick)");
}

TEST_CASE("the shortest run to a result counts ticks of the leaves and time") {
  CHECK(Verified("a", R"(<leaf path="*" ticks="3..5"/>)").said("results") ==
        "success (from 3 ticks), failure (from 3 ticks)");
  CHECK(Verified("Wait[seconds=.3]").said("results") == "success (from 4 ticks)");
  CHECK(Verified("Timeout[seconds=.3](a)", R"(<leaf path="*" result="success" ticks="9..inf"/>)")
            .said("results") == "failure (from 4 ticks)");
  CHECK(Verified("Sequence(a b)", R"(<leaf path="*" result="failure"/>)").said("results") ==
        "failure (from 1 tick)");
}

TEST_CASE("a leaf that may not succeed yet goes on behind its last tick, in the same states") {
  for (const std::string step : {"0..1", "0"}) {
    const Verified it(
        "ParallelAbsolute[barriers=.5](a AlwaysSuccess)",
        R"(<leaf path="*" ticks="2..5" result="success" finish="full" step=")" + step + R"("/>)",
        {.states = 1000});
    INFO(step);
    CHECK(it.found.is_complete());
    CHECK(it.found.store.size() < 50);
  }
}

TEST_CASE("an activation completes after so many ticks at most") {
  const Verified it("a", R"(<leaf path="*" result="success" ticks="2..3"/>)");
  CHECK(it.found.store.size() == 3);  // before the first tick, after it and after the second
  CHECK(it.said("always ends") == "yes");
}

TEST_CASE("a fact is the same for all that name it in a tick") {
  const Verified free("Sequence(a? Inverter(b?))");
  CHECK(free.said("results") == "success (from 1 tick), failure (from 1 tick)");
  const Verified same("Sequence(a? Inverter(b?))", R"(<fact name="day"/>
    <leaf path="*" fact="day"/>)");
  CHECK(same.said("results") == "failure (from 1 tick)");
}

TEST_CASE("a fact that does not change by itself is what it was, until an action sets it") {
  // Fails once, and then succeeds: only if the fact changes.
  constexpr auto kTree = "Sequence[memory=true](Inverter(a?) b c?)";
  const auto results = [&](std::string_view changes, std::string_view sets) {
    return Verified(kTree, "<fact name=\"day\" changes=\"" + std::string(changes) +
                               "\"/><leaf path=\"*/a\" fact=\"day\"/>"
                               "<leaf path=\"*/c\" fact=\"day\"/><leaf path=\"*/b\" " +
                               "result=\"success\" ticks=\"2\"" + std::string(sets) + "/>")
        .said("results");
  };
  CHECK(results("never", "") == "failure (from 1 tick)");
  CHECK(results("never", " sets=\"day=true\"") == "success (from 2 ticks), failure (from 1 tick)");
  CHECK(results("freely", "") == "success (from 2 ticks), failure (from 1 tick)");
  CHECK(results("rises", "") == "success (from 2 ticks), failure (from 1 tick)");
  CHECK(results("falls", "") == "failure (from 1 tick)");
}

TEST_CASE("what a limit stops is bounded, and the first ticks are complete") {
  const std::string tree = absolute(3, 8);
  const Verified states(tree, R"(<leaf path="*" step="0..1"/>)", {.states = 50});
  CHECK(states.found.end == SearchEnd::States);
  CHECK_FALSE(states.found.is_complete());
  CHECK(states.found.store.size() > 50);
  const Verified depth(tree, R"(<leaf path="*" step="0..1"/>)", {.depth = 2});
  CHECK(depth.found.end == SearchEnd::Depth);
  CHECK(depth.found.complete_depth() == 2);
  CHECK(depth.said("never ticked").empty());  // nobody knows
  const Verified signal(tree, "", {.stop_signal = [] { return 2; }});
  CHECK(signal.found.end == SearchEnd::Signal);
  CHECK(signal.found.signal == 2);
}

TEST_CASE("a limit of memory counts what a round takes, and what the verdict needs") {
  const std::string tree = absolute(6, 20);
  constexpr std::size_t kMost = std::size_t{4} << 20u;
  const Verified it(tree, R"(<leaf path="*" step="0..3"/>)", {.memory = kMost, .symmetry = false});
  CHECK(it.found.end == SearchEnd::Memory);
  CHECK(it.found.memory() < kMost);
}

TEST_CASE("the questions of a verdict end with the time, and what is not answered is not proven") {
  const auto said = [](const Verdict& verdict, std::string_view name) {
    const auto line = std::ranges::find(verdict.facts, name, &VerdictLine::name);
    return line == verdict.facts.end() ? "" : line->text;
  };
  const std::string nothing_left = "not known: --time leaves nothing for it";
  const Verified it(absolute(2, 1), R"(<leaf path="*" step="0..1"/>)");
  const auto verdict_until = [&](Nanoseconds until) {
    return make_verdict(it.tree, it.models, it.properties, it.found, {.until = until});
  };
  const Verdict cut = verdict_until(Nanoseconds(0));
  CHECK(cut.is_cut);
  for (const std::string& name :
       {std::string("can always end"), std::string("always ends"), "held: " + it.tree.path(1)}) {
    CHECK(said(cut, name) == nothing_left);
  }
  CHECK(said(cut, "results") == said(it.verdict, "results"));
  const Verdict enough = verdict_until(monotonic_now() + std::chrono::hours(1));
  CHECK_FALSE(enough.is_cut);
  CHECK(enough.facts.size() == it.verdict.facts.size());
  CHECK(said(enough, "can always end") == "yes");
}

TEST_CASE("who is held for how long is not asked where a limit leaves nothing for it") {
  const Verified it(absolute(2, 1), R"(<leaf path="*" step="0..1"/>)");
  const std::string name = "held: " + it.tree.path(1);
  CHECK(it.said(name) == "as long as others take");
  const auto held = [&](const VerdictOptions& options) {
    const Verdict verdict = make_verdict(it.tree, it.models, {}, it.found, options);
    const auto line = std::ranges::find(verdict.facts, name, &VerdictLine::name);
    return line == verdict.facts.end() ? "" : line->text;
  };
  CHECK(held({.until = Nanoseconds(0)}) == "not known: --time leaves nothing for it");
  CHECK(held({.memory = 1}) == "not known: --memory leaves nothing for it");
}

TEST_CASE("a limit also counts within the many ticks of one period") {
  std::string children;
  for (int i = 0; i < 3; ++i) {
    children += "Repeat[num_cycles=-1](RetryUntilSuccessful[num_attempts=3](Fallback(Sequence(a" +
                std::to_string(i) + " b" + std::to_string(i) + ") c" + std::to_string(i) + "))) ";
  }
  int looks = 0;  // at a clock, they would depend on the machine
  const Verified it("Parallel(" + children + ")", "",
                    {.stop_signal = [&looks] { return ++looks > 1000 ? 2 : 0; }}, 10, {},
                    btcpp::kRules);
  CHECK(it.found.end == SearchEnd::Signal);
  CHECK(looks < 1100);
  CHECK_FALSE(it.found.faults.empty());
  // So that no tick before it is made again to show it.
  for (const auto& [node, fault] : it.found.faults) CHECK_FALSE(fault.second.answers.empty());
}

TEST_CASE("an entry with more and more values stops the search, and is named") {
  const Verified it(
      "Sequence[memory=true](Script[code=n:=0] Repeat(Sequence(Script[code=n=n+1] a)))", "",
      {.values = 20});
  CHECK(it.found.end == SearchEnd::Values);
  CHECK(it.found.note == "n");
}

void check_same(const Graph& a, const Graph& b) {
  REQUIRE(a.expanded() == b.expanded());
  for (StateId i = 0; i < a.expanded(); ++i) {
    if (!std::ranges::equal(a.edges[i], b.edges[i])) FAIL("state " << i);
  }
  CHECK(a.ends == b.ends);
  CHECK(a.equals == b.equals);
  REQUIRE(a.labels.size() == b.labels.size());
  for (std::uint32_t i = 0; i < a.labels.size(); ++i) {
    CHECK(std::ranges::equal(a.labels.packed(i), b.labels.packed(i)));
  }
}

// All that a verdict is made of.
void check_same(const SearchResult& a, const SearchResult& b) {
  CHECK(a.end == b.end);
  CHECK(a.store.size() == b.store.size());
  CHECK(a.transitions == b.transitions);
  CHECK(a.depths == b.depths);
  check_same(a.graph, b.graph);
  check_same(a.graph_of_cycles(), b.graph_of_cycles());
}

TEST_CASE("the way to a state is a shortest one, over edges that the search has found") {
  for (const std::string& tree :
       {absolute(3, 4), std::string("Repeat(Sequence(c? a Retry[attempts=2](b)))")}) {
    const Verified it(tree);
    const SearchResult& found = it.found;
    for (StateId state = 0; state < found.store.size(); ++state) {
      const std::vector<StateId> path = found.path_to(state);
      REQUIRE(path.size() == found.depth_of(state) + 1);
      CHECK(path.front() == 0);
      CHECK(path.back() == state);
      for (std::size_t i = 1; i < path.size(); ++i) {
        CHECK(std::ranges::any_of(found.graph.edges_of(path[i - 1]),
                                  [&](const Edge& edge) { return edge.to == path[i]; }));
      }
    }
  }
}

TEST_CASE("the edges of cycles have labels that say who worked and who ended") {
  const Verified it("Repeat(Sequence[memory=true](a b))", R"(<leaf path="*" ticks="1..3"/>)");
  const SearchResult& found = it.found;
  REQUIRE(found.cycles != nullptr);
  const LabelShape& shape = found.cycles->shape;
  std::size_t works = 0, ends = 0;
  for (StateId state = 0; state < found.cycles->expanded(); ++state) {
    for (const Edge& edge : found.cycles->edges_of(state)) {
      works += found.cycles->has(edge, shape.worked_bit(0));
      ends += found.cycles->has(edge, shape.ended_bit(1));
      CHECK(std::ranges::any_of(found.graph.edges_of(state),
                                [&](const Edge& other) { return other.to == edge.to; }));
    }
  }
  CHECK(works > 0);
  CHECK(ends > 0);
  // Without such a cycle, nothing is ticked again.
  CHECK(Verified("Sequence[memory=true](a b)").found.cycles == nullptr);
}

TEST_CASE("beside cycles of several states, a state that is a cycle by itself keeps its label") {
  const Verified it("Sequence[memory=true](d Repeat(Sequence[memory=true](a b)))");
  REQUIRE(it.found.cycles != nullptr);
  const Graph& cycles = *it.found.cycles;
  std::size_t loops = 0;
  for (StateId state = 0; state < cycles.expanded(); ++state) {
    for (const Edge& edge : cycles.edges_of(state)) {
      loops += edge.to == state && cycles.has(edge, cycles.shape.worked_bit(0));
    }
  }
  CHECK(loops == 1);
}

TEST_CASE("any number of threads finds the same, in the same order") {
  constexpr auto kReactive = "Fallback(Sequence(c? Parallel(a b)) Sequence[memory=true](d e f))";
  constexpr auto kEndless = "Repeat(Sequence[memory=true](ParallelAbsolute[barriers=.5](a b) d))";
  for (const std::string& tree : {absolute(3, 8), std::string(kReactive), std::string(kEndless)}) {
    const Verified one(tree), again(tree), three(tree, "", {.jobs = 3});
    check_same(one.found, again.found);
    check_same(one.found, three.found);
  }
}

TEST_CASE("a limit that counts ends a search of any number of threads at the same state") {
  for (const SearchLimits& limits :
       {SearchLimits{.states = 150}, SearchLimits{.depth = 1}, SearchLimits{.transitions = 3000}}) {
    SearchLimits of_three = limits;
    of_three.jobs = 3;
    const Verified one(absolute(3, 8), "", limits), three(absolute(3, 8), "", of_three);
    CHECK_FALSE(one.found.is_complete());
    check_same(one.found, three.found);
  }
}

TEST_CASE("a limit of transitions counts each tick of the root that a node asks for") {
  // 10,000 ticks in one period for each combination of answers, up to a fault.
  constexpr auto kEndless = "Repeat[num_cycles=-1](Fallback(a b))";
  constexpr auto kMany = "Parallel(Repeat[num_cycles=300](AlwaysSuccess) a b c d)";
  for (const auto* tree : {kEndless, kMany}) {
    for (const std::uint64_t most : {100u, 20'000u}) {
      const SearchLimits limits{.transitions = most}, of_three{.transitions = most, .jobs = 3};
      const Verified one(tree, "", limits, 10, {}, btcpp::kRules);
      const Verified three(tree, "", of_three, 10, {}, btcpp::kRules);
      INFO(tree << ", " << most);
      CHECK(one.found.end == SearchEnd::Transitions);
      CHECK(one.found.root_ticks > most - 32);
      CHECK(one.found.root_ticks < most + 1500);
      CHECK(one.found.root_ticks > 10 * one.found.transitions);
      check_same(one.found, three.found);
    }
  }
}

TEST_CASE("a search that has reached a limit makes no further ticks") {
  std::string leaves = "a";
  for (int i = 1; i < 64; ++i) leaves += " a";
  int looks = 0;  // at the signal: one in 32 ticks
  const Verified it("Sequence[memory=true](" + leaves + ')', "",
                    {.states = 10, .stop_signal = [&] { return ++looks, 0; }});
  CHECK(it.found.end == SearchEnd::States);
  CHECK(looks < 16);  // those of the first state, in place of 64 states
}

TEST_CASE("a limit ends a tick of very many leaves after fewer combinations") {
  std::string leaves = "a";
  for (int i = 1; i < 5000; ++i) leaves += " a";
  const Verified it("Parallel(" + leaves + ')', "", {.states = 10, .symmetry = false});
  CHECK(it.found.end == SearchEnd::States);
  CHECK(it.found.store.size() > 10);
  CHECK(it.found.store.size() < 400);
}

TEST_CASE("hashes in place of states: a property that looks below what has ended") {
  const Verified it("Sequence[memory=true](Fallback(c?) KeepRunningUntilFailure(AlwaysSuccess))",
                    "", {.hash_bits = 64}, 10, {"never Fallback.success and not c.failure"});
  CHECK(it.findings() == "trap, property/never Fallback.success and not c.failure");
}

TEST_CASE("hashes in place of states: the same states, findings and runs in less memory") {
  constexpr auto kDeadlock =
      "Parallel(SyncProgress[barrier=coarse](SyncProgress[barrier=fine](a)) "
      "SyncProgress[barrier=coarse](Sequence[memory=true](b SyncProgress[barrier=fine](c)))) "
      "barrier[name=coarse barriers=.5] barrier[name=fine barriers=.25]";
  for (const std::string& tree :
       {absolute(4, 4), std::string("Sequence(a b)"), std::string(kDeadlock),
        std::string("Repeat(Sequence[memory=true](a Retry[attempts=2](b)))")}) {
    INFO(tree);
    constexpr auto kFull = R"(<leaf path="*" finish="full" result="success"/>)";
    const Verified states(tree, kFull, {.symmetry = false});
    const Verified hashes(tree, kFull, {.hash_bits = 64, .symmetry = false});
    const Verified threads(tree, kFull, {.jobs = 3, .hash_bits = 64, .symmetry = false});
    check_same(states.found, hashes.found);
    check_same(hashes.found, threads.found);
    CHECK(hashes.findings() == states.findings());
    for (const Finding& it : states.verdict.findings) {
      CHECK(hashes.script(it.name) == states.script(it.name));
    }
    CHECK(states.found.is_proof());
    CHECK(hashes.found.is_complete());
    CHECK_FALSE(hashes.found.is_proof());
    CHECK(hashes.found.memory() < states.found.memory() + 4096);
  }
}

TEST_CASE(
    "hashes in place of states: some are lost where hashes are short, and it is said how surely") {
  constexpr auto kFull = R"(<leaf path="*" finish="full" result="success"/>)";
  const Verified states(absolute(4, 4), kFull, {.symmetry = false});
  std::size_t lost = 0;
  for (const unsigned bits : {8u, 10u, 12u, 16u, 32u, 64u}) {
    INFO(bits);
    // Without a verdict: two states that are one can make a cycle that no run has, and it says so.
    const SearchResult hashes =
        search(states.tree, states.models, {}, 10, {.hash_bits = bits, .symmetry = false});
    const double states_found = static_cast<double>(hashes.store.size());
    const double loss = hashes.store.probability_of_loss();
    CHECK(loss == Approx(std::min(1.0, states_found * (states_found + 1) / 2 / std::exp2(bits))));
    CHECK_FALSE(hashes.is_proof());
    if (hashes.store.size() == states.found.store.size()) continue;
    ++lost;
    CHECK(hashes.store.size() < states.found.store.size());
    CHECK(loss > 0.5);
  }
  CHECK(lost >= 3);
}

TEST_CASE("a loop within a tick is gone through once, whatever others do meanwhile") {
  struct Row {
    const char *law, *tree, *rows;
  };
  for (const Row& it : {
           Row{"a Retry without an end beside an action",
               "Parallel[success_count=2](RetryUntilSuccessful[num_attempts=-1](AlwaysFailure) a)",
               R"(<leaf path="*" progress="grid:4"/>)"},
           Row{"the same of a Repeat, whose child is one as well",
               "Parallel[success_count=2](Repeat[num_cycles=-1](b) a)", ""},
           Row{"of a Retry around a Sequence",
               "ParallelRelative[delta=.5](RetryUntilSuccessful[num_attempts=-1](Sequence(c? b)) "
               "a)",
               ""},
       }) {
    INFO(it.law);
    const Verified verified(it.tree, it.rows, {.transitions = 50'000'000}, 10,
                            {"never a.failure", "sometimes a.failure"}, btcpp::kRules);
    CHECK(verified.found.is_complete());
    // It plays all 10,000 rounds.
    const auto& findings = verified.verdict.findings;
    const bool has_fault = std::ranges::any_of(
        findings, [](const Finding& one) { return one.name.starts_with("fault/"); });
    CHECK(has_fault);
    CHECK(verified.finding("property/never a.failure") != nullptr);
    CHECK(verified.finding("property/sometimes a.failure") != nullptr);
  }
}

TEST_CASE(
    "conditions that change nothing take a few ticks each, and not one for all combinations") {
  for (const char* node :
       {"ForceSuccess(c?)", "Fallback(c? AlwaysSuccess)", "Inverter(ForceFailure(c?))",
        "Parallel[success_count=1 failure_count=2](c? AlwaysSuccess)"}) {
    INFO(node);
    std::string children;
    for (int i = 0; i < 20; ++i) children += std::string(node) + " ";
    const Verified twenty("Sequence[memory=true](" + children + ")");
    CHECK(twenty.found.is_complete());
    CHECK(twenty.found.transitions <= kFewTicks + 2 * 20);
    for (NodeIndex it = 0; it < twenty.tree.nodes.size(); ++it) {
      if (twenty.tree.labels[it].type->leaf == nullptr) continue;
      CHECK(twenty.found.coverage.has_been(it, Status::Success));
      CHECK(twenty.found.coverage.has_been(it, Status::Failure));
    }
  }
}

TEST_CASE("what the others do in a Parallel that is sure to end is looked at once") {
  std::string children;
  for (int i = 0; i < 8; ++i) children += "child" + std::to_string(i) + " ";
  const Verified it("Parallel(" + children + ")", "", {.symmetry = false});
  CHECK(it.found.store.size() == (1u << 8u));
  // Of all that each child may do: runs, succeeds, fails.
  std::uint64_t all = 0;
  for (unsigned state = 0; state < (1u << 8u); ++state) {
    std::uint64_t ticks = 1;
    for (unsigned child = 0; child < 8; ++child) ticks *= (state >> child & 1u) != 0 ? 1 : 3;
    all += ticks;
  }
  CHECK(it.found.transitions < all / 2);
}

TEST_CASE("points of a tick at which the same follows change nothing in what is found") {
  for (const char* tree :
       {"Parallel(Fallback[memory=true](Sequence(a b) c) Sequence[memory=true](Inverter(d) e))",
        "ParallelAbsolute[barriers=.5](Sequence(c? a) Fallback(d? b))",
        "Parallel[success_count=2](a b Fallback(c? ForceFailure(d?)))",
        "Repeat[times=2](ForceSuccess(Parallel[success_count=1](Sequence[memory=true](a b) c d)))",
        "Retry[attempts=2](ParallelAbsolute[barriers=.5 failure_count=2 success_count=2](a b c))",
        "Parallel[failure_count=1](b Fallback(a) c)",
        "Fallback(ParallelRelative[delta=.5](RunOnce(a) Cooldown[seconds=.3](b) c) d)",
        "Sequence(Fallback(c? d?) Retry[attempts=3](a) ForceSuccess(b))",
        "Sequence(Script[code=n:=0] Fallback(c? Script[code=n=1]) Fallback(d? Script[code=n=2]) "
        "Retry[attempts=2](a) Fallback(Check[code=n==2] b))"}) {
    INFO(tree);
    const auto verified = [&](std::uint64_t few) {
      return Verified(tree, R"(<leaf path="*" progress="grid:2"/>)", {.few_ticks = few}, 10,
                      {"never a.failure and b.running", "a.success leads to b.success",
                       "sometimes a.success", "after a.failure never a.failure"});
    };
    const Verified all = verified(kAllTicks), shared = verified(0);
    REQUIRE(all.found.is_complete());
    CHECK(shared.found.is_complete());
    CHECK(shared.found.transitions <= all.found.transitions);
    check_same(shared.found.graph, all.found.graph);
    CHECK(shared.found.store.size() == all.found.store.size());
    CHECK(shared.findings() == all.findings());
    for (const char* line : {"results", "never succeeds", "never fails", "never ticked"}) {
      CHECK(shared.said(line) == all.said(line));
    }
  }
}

// In a later tick of the root, a leaf has the marks of an earlier one.
TEST_CASE("points of a later tick of the root are told apart by what a leaf asks") {
  const auto success = [](std::uint64_t few) {
    const Verified it(
        "ReactiveSequence(a[out={n}] AsyncSequence(ParallelAll(b[out={n} _while=n!=1] c[out={n}]?) "
        "Sleep[msec=300]))",
        R"(<leaf path="*" result="success" out.out="0|1" writes="success" progress="none"/>
           <leaf path="*/b" ticks="1"/>)",
        {.few_ticks = few}, 10, {}, btcpp::kRules);
    return it.said("results");
  };
  CHECK(success(kAllTicks) == "success (from 4 ticks)");
  CHECK(success(0) == "success (from 4 ticks)");
}

TEST_CASE("rounds that are told apart by their states change nothing in what is found") {
  for (const char* tree : {"Parallel[success_count=2](Repeat[num_cycles=4](b) "
                           "RetryUntilSuccessful[num_attempts=3](a))",
                           "ParallelAbsolute[barriers=.5](RetryUntilSuccessful[num_attempts=4](a) "
                           "KeepRunningUntilFailure(b))",
                           "AsyncSequence(a Repeat[num_cycles=3](AsyncFallback(b c?)) d)"}) {
    INFO(tree);
    const auto verified = [&](std::uint64_t few) {
      return Verified(tree, R"(<leaf path="*" progress="grid:2"/>)",
                      {.transitions = 20'000'000, .few_root_ticks = few}, 10,
                      {"never a.failure and b.running", "a.success leads to b.success",
                       "b.held at most 1 ticks"},
                      btcpp::kRules);
    };
    const Verified plain = verified(1'000'000'000), told_apart = verified(0);
    REQUIRE(plain.found.is_complete());
    CHECK(told_apart.found.is_complete());
    CHECK(told_apart.found.transitions <= plain.found.transitions);
    CHECK(told_apart.found.store.size() == plain.found.store.size());
    CHECK(told_apart.findings() == plain.findings());
    CHECK(told_apart.said("results") == plain.said("results"));
    CHECK(told_apart.said("never succeeds") == plain.said("never succeeds"));
    CHECK(told_apart.said("never fails") == plain.said("never fails"));
  }
}

}  // namespace lockstep::host::test

// Probabilities that were computed by hand, and those of random trees, which a few lines compute
// from the formulas of each node.
#include "verify/probability.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "verify/verified.h"

namespace lockstep::host::test {
namespace {

Probabilities probabilities_of(std::string_view tree, std::string_view rows,
                               std::vector<std::string> properties = {},
                               const SearchLimits& limits = {}) {
  const Verified it(tree, rows, {.depth = 1}, 10, std::move(properties));
  return probabilities(explore_chances(it.tree, it.models, it.properties, it.rate, limits),
                       [] { return false; });
}

Probability success_of(std::string_view tree, std::string_view rows) {
  const auto found = probabilities_of(tree, rows).results[index_of(Status::Success)];
  return found.value_or(Probability{{0, 0}, {0, 0}});
}

// The bounds hold what is true, and little else.
void check(const Bounds& bounds, double value) {
  INFO(fmt::format("[{}, {}], not {}", bounds.low, bounds.high, value));
  CHECK(bounds.low <= value);
  CHECK(bounds.high >= value);
  CHECK(bounds.width() < 1e-8);
}
void check(const Probability& it, double least, double most) {
  check(it.least, least);
  check(it.most, most);
}
void check(const Probability& it, double value) {
  check(it, value, value);
}

std::string row(std::string_view leaf, double success, std::string_view more = "") {
  return fmt::format(R"(<leaf path="*{}" result="success:{:.17g};failure:{:.17g}" {}/>)", leaf,
                     success, 1 - success, more);
}

// In the language, a loop that only ends with a success.
std::string until_success(std::string_view child) {
  return fmt::format("Inverter(Repeat(Inverter({})))", child);
}

}  // namespace

TEST_CASE("probabilities of small trees are those found by hand") {
  check(success_of("a", row("a", 0.7)), 0.7);
  check(success_of("Retry[attempts=3](a)", row("a", 0.7)), 0.973);
  check(success_of("Fallback[memory=true](a b)", row("a", 0.7) + row("b", 0.5)), 0.85);
  check(success_of("Sequence[memory=true](a b)", row("a", 0.7) + row("b", 0.5)), 0.35);
  check(success_of("Parallel(a b)", row("a", 0.7) + row("b", 0.5)), 0.35);
  check(success_of("Inverter(a)", row("a", 0.7)), 0.3);
  check(success_of("Fallback(a? b?)", row("a", 0.25) + row("b", 0.5)), 0.625);
  const Probabilities three =
      probabilities_of("a", R"(<leaf path="*" result="success:0.5;failure:0.125;fault:0.375"/>)");
  check(*three.results[index_of(Status::Success)], 0.5);
  check(*three.results[index_of(Status::Failure)], 0.125);
  check(*three.fault, 0.375);
  check(three.ends, 1);
}

TEST_CASE("a loop without an end ends with probability 1 where chance lets it") {
  const Probabilities slow = probabilities_of(until_success("a"), row("a", 0.001));
  check(*slow.results[index_of(Status::Success)], 1);
  check(slow.ends, 1);
  CHECK_FALSE(slow.results[index_of(Status::Failure)]);
  const Probabilities never = probabilities_of("Repeat(" + until_success("a") + ")", row("a", 0.5));
  check(never.ends, 0);
}

TEST_CASE("what has no chance gives a least and a largest probability") {
  const std::string any = R"(<leaf path="*b" result="success;failure"/>)";
  check(success_of("Fallback[memory=true](a b)", row("a", 0.7) + any), 0.7, 1);
  check(success_of("Sequence[memory=true](b a)", row("a", 0.7) + any), 0, 0.7);
  // It fails again and again: fair, but no end.
  const Probabilities it = probabilities_of(until_success("b"), any);
  check(it.ends, 0, 1);
  check(*it.results[index_of(Status::Success)], 0, 1);
  // It would have to run for ever, which only a leaf does that says so.
  check(probabilities_of("a", row("a", 0.5)).ends, 1);
  check(probabilities_of("a", row("a", 0.5, R"(ends="no")")).ends, 0, 1);
  // Ticks that chance follows are chosen, as here before it is known whether both fail.
  check(success_of("Parallel[success_count=1 failure_count=2](a Sequence[memory=true](b c))",
                   row("a", 0.5) + row("b", 0.5) + row("c", 0.5)),
        0.625);
}

TEST_CASE("without memory, a slow second child lets the first one try again") {
  check(success_of("Fallback(a b)", row("a", 0.7) + row("b", 0.5)), 0.85, 1);
  check(success_of("Fallback(a b)", row("a", 0.7, R"(ticks="1")") + row("b", 0.5, R"(ticks="1")")),
        0.85);
}

TEST_CASE("an action with chances and finish full ends where it reaches 1") {
  const std::string rows = row("a", 0.7, R"(finish="full" step="1" progress="grid:4")");
  check(success_of("ParallelAbsolute[barriers=.5](a)", rows), 0.7);
  check(success_of("Timeout[seconds=.3](a)", rows), 0);  // not before its fourth tick
}

TEST_CASE("the probability that a property holds") {
  const std::string rows = row("a", 0.7) + row("b", 0.5);
  const Probabilities it = probabilities_of(
      "Sequence[memory=true](a b)", rows,
      {"never b.failure", "sometimes b.success", "finally a.success", "a.failure leads to b.done"});
  REQUIRE(it.properties.size() == 4);
  check(it.properties[0], 0.65);
  check(it.properties[1], 0.35);
  check(it.properties[2], 0.7);
  check(it.properties[3], 0.7);
  // One that waits for ever is violated.
  const Probabilities endless = probabilities_of("Repeat(ForceSuccess(a))", row("a", 0.7),
                                                 {"sometimes a.success", "never a.failure"});
  check(endless.properties[0], 1);
  check(endless.properties[1], 0);
  const Probabilities stuck =
      probabilities_of("Sequence[memory=true](a ForceSuccess(b) Repeat(ForceSuccess(c)))",
                       row("a", 0.7) + row("b", 0.5) + row("c", 0.5), {"sometimes b.failure"});
  check(stuck.properties[0], 0.35);
}

TEST_CASE("facts have chances and start values, and failures set them") {
  const auto fact = [](std::string_view more) {
    return fmt::format(R"(<fact name="day" {}/><leaf path="*" fact="day"/>)", more);
  };
  check(success_of("a?", fact(R"(chance="0.2")")), 0.2);
  check(success_of("Sequence(a? b?)", fact(R"(chance="0.2")")), 0.2);  // once in a tick
  check(success_of("Retry[attempts=2](a?)", fact(R"(chance="0.2")")), 0.36);
  check(success_of("Retry[attempts=2](a?)", fact(R"(chance="0.2" changes="never")")), 0.2);
  check(success_of("a?", fact(R"(changes="never" starts="true")")), 1);
  check(success_of("a?", fact(R"(changes="rises" starts="false" chance="0.1")")), 0.1);
  check(success_of("Sequence[memory=true](ForceSuccess(b) a?)",
                   R"(<fact name="whole" changes="never" starts="true"/>)" +
                       row("b", 0.7, R"(sets_on_failure="whole=false")") +
                       R"(<leaf path="*a" fact="whole"/>)"),
        0.7);
}

// As public models of a statistical model checker, in own words: a dock that only charges a robot
// which has found it; an assembly that recovers from a failed move; a grasp with two tries.
TEST_CASE("a docking, an assembly and a grasp have the probabilities that are known of them") {
  const std::string_view dock = R"(<fact name="docked" changes="never" starts="false"/>)"
                                R"(<leaf path="*dock" result="success" sets="docked=true"/>)"
                                R"(<leaf path="*charges" fact="docked"/>)";
  check(success_of("Sequence[memory=true](dock charges?)", dock), 1);
  check(success_of("Sequence[memory=true](charges? dock)", dock), 0);
  const std::vector<std::string> handled{"sometimes move.success or recover.running"};
  const std::string rows =
      row("move", 0.7, R"(ticks="1..5")") + R"(<leaf path="*recover" result="success" ticks="2"/>)";
  const auto handled_in = [&](std::string_view kind) {
    const std::string tree = fmt::format("{}[memory=true](move recover)", kind);
    return probabilities_of(tree, rows, handled).properties[0];
  };
  check(handled_in("Fallback"), 1);
  check(handled_in("Sequence"), 0.7);
  check(success_of("Retry[attempts=2](grasp)", row("grasp", 0.8)), 0.96);
}

TEST_CASE("where a search has a limit, the bounds are wide, but hold the probability") {
  const auto it = probabilities_of("Retry[attempts=9](a)", row("a", 0.5), {}, {.states = 3});
  const Probability& success = *it.results[index_of(Status::Success)];
  const double exact = 1 - std::pow(0.5, 9);
  CHECK(success.most.high > exact);
  CHECK(success.most.low < exact);
  CHECK(success.most.low > 0.4);
  CHECK(success.most.width() > 1e-3);
  CHECK(it.ends.most.high == 1);
}

namespace {

// A tree in which each leaf is there once, and the least and largest probability that it succeeds:
// where no time counts, they follow from those of the children.
class FormulaTree {
 public:
  explicit FormulaTree(std::uint32_t seed) : random_(seed) { text = node(3, least, most); }

  std::string text, rows;
  double least = 0, most = 1;

 private:
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(random_() % count); }

  std::string node(int depth, double& low, double& high) {
    if (depth == 0 || below(6) == 0) return leaf(low, high);
    switch (below(7)) {
      case 0: {
        const std::string inner = node(depth - 1, low, high);
        std::tie(low, high) = std::pair(1 - high, 1 - low);
        return "Inverter(" + inner + ")";
      }
      case 1: {
        const std::uint32_t times = 1 + below(3);
        const std::string inner = node(depth - 1, low, high);
        low = 1 - std::pow(1 - low, times);
        high = 1 - std::pow(1 - high, times);
        return fmt::format("Retry[attempts={}]({})", times, inner);
      }
      case 2: {
        const std::uint32_t times = 1 + below(3);
        const std::string inner = node(depth - 1, low, high);
        low = std::pow(low, times);
        high = std::pow(high, times);
        return fmt::format("Repeat[times={}]({})", times, inner);
      }
      case 3:
        return children(depth, "Sequence[memory=true]", true, low, high);
      case 4:
        return children(depth, "Parallel", true, low, high);
      case 5:
        return children(depth, "Parallel[success_count=1 failure_count=2]", false, low, high);
      default:
        return children(depth, "Fallback[memory=true]", false, low, high);
    }
  }

  std::string children(int depth, std::string_view kind, bool all, double& low, double& high) {
    double other_low = 0, other_high = 0;
    const std::string one = node(depth - 1, low, high);
    const std::string other = node(depth - 1, other_low, other_high);
    low = all ? low * other_low : 1 - (1 - low) * (1 - other_low);
    high = all ? high * other_high : 1 - (1 - high) * (1 - other_high);
    return fmt::format("{}({} {})", kind, one, other);
  }

  std::string leaf(double& low, double& high) {
    const std::string name = fmt::format("leaf{}x", leaves_++);
    const std::string ticks = std::string("ticks=\"") + (below(2) == 0 ? "1" : "1..inf") + '"';
    if (below(4) == 0) {
      rows += fmt::format(R"(<leaf path="*{}" {}/>)", name, ticks);
      low = 0;
      high = 1;
    } else {
      low = high = (1 + below(9)) / 10.0;
      rows += row(name, low, ticks);
    }
    return name;
  }

  std::mt19937 random_;
  int leaves_ = 0;
};

}  // namespace

TEST_CASE("probabilities of random trees are those that follow from their formulas") {
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    const FormulaTree it(seed);
    INFO(seed << ": " << it.text << "\n" << it.rows);
    const Probability success = success_of(it.text, it.rows);
    // What the formulas round.
    constexpr double kRounding = 1e-14;
    CHECK(std::abs(success.least.low - it.least) < 1e-8);
    CHECK(std::abs(success.most.high - it.most) < 1e-8);
    CHECK(success.least.low <= it.least + kRounding);
    CHECK(success.least.high >= it.least - kRounding);
    CHECK(success.most.low <= it.most + kRounding);
    CHECK(success.most.high >= it.most - kRounding);
  }
}

}  // namespace lockstep::host::test

// The cart scene of plugins/r1sim: what the experiment shows must hold, and the base must move when
// it is ticked and stand when it is held.
#include <catch2/catch.hpp>

#include "unit/plugins/tree_run.h"

namespace lockstep::host::test {
namespace {

std::string push_cart(const std::string& delta, const std::string& cart, const std::string& base) {
  return "<ParallelRelative success_count=\"1\" delta=\"" + delta + "\"><HoldCart name=\"arms\" " +
         cart + "/><FollowPath name=\"base\" " + base + "/></ParallelRelative>";
}

int successes(const std::string& delta, double rate) {
  const TreeRunner runner("r1sim", push_cart(delta, "", ""));
  int count = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const TreeRunEnd end = runner.run({.seed = seed, .rate = rate});
    CHECK(end.status != Status::Running);
    CHECK(end.fault.empty());
    count += end.status == Status::Success;
  }
  return count;
}

TEST_CASE("the cart is lost unless arms and base are in step, at any rate", "[plugins][cart]") {
  for (const double rate : {20.0, 100.0, 500.0}) {
    INFO("at " << rate << " Hz");
    CHECK(successes("0", rate) >= 38);
    CHECK(successes("1", rate) <= 12);
  }
}

TEST_CASE("a path takes its length over its speed, at any rate", "[plugins][cart]") {
  const TreeRunner runner("r1sim", push_cart("0", "drift=\"0\"", "path=\"3\" speed=\"0.5\""));
  for (const double rate : {20.0, 100.0, 1000.0}) {
    const TreeRunEnd end = runner.run({.rate = rate});
    CHECK(end.status == Status::Success);
    CHECK(end.seconds == Approx(6).margin(3 / rate));
  }
}

TEST_CASE("the base stands still while it is held, and only then", "[plugins][cart]") {
  const TreeRunner runner("r1sim", push_cart("0", "drift=\"0.3\"", "path=\"5\" speed=\"0.5\""));
  const NodeIndex base = runner.node("base");
  double held = 0;
  double driving = 0;
  const auto measure = [&](Ticker& ticker) {
    if (ticker.status(base) != Status::Running) return;
    (ticker.held(base) ? held : driving) += 0.01;
  };
  CHECK(runner.run({.after_tick = measure}).status == Status::Success);
  CHECK(held > 1);
  CHECK(driving == Approx(10).margin(0.05));
}

TEST_CASE("the arms let go of nothing while the path is not done", "[plugins][cart]") {
  const TreeRunner runner("r1sim", "<HoldCart/>");
  CHECK(runner.run({.limit = 20}).status == Status::Running);
}

TEST_CASE("arms that were held align the cart again", "[plugins][cart]") {
  const TreeRunner runner("r1sim", push_cart("0", "slip=\"9\"", "drift=\"0.2\" boundary=\"0.03\""));
  const NodeIndex arms = runner.node("arms");
  int held = 0;
  const auto count = [&](Ticker& ticker) { held += ticker.held(arms); };
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    CHECK(runner.run({.seed = seed, .after_tick = count}).status == Status::Success);
  }
  CHECK(held > 0);
}

TEST_CASE("the arms' progress is 1 within the boundary, else 0", "[plugins][cart]") {
  const TreeRunner runner("r1sim", push_cart("0", "error=\"{error}\"", ""));
  const NodeIndex arms = runner.node("arms");
  int within = 0, beyond = 0;
  const auto compare = [&](Ticker& ticker) {
    if (!ticker.ticked(arms) || ticker.status(arms) != Status::Running) return;
    const double error = std::get<double>(ticker.blackboard().entries[0].value());
    const bool is_within = std::abs(error) <= 0.04;
    ++(is_within ? within : beyond);
    CHECK(ticker.progress(arms) == (is_within ? 1 : 0));
  };
  CHECK(runner.run({.after_tick = compare}).status == Status::Success);
  CHECK(within > 100);
  CHECK(beyond > 100);
}

TEST_CASE("hysteresis makes the base stop less often, and for longer", "[plugins][cart]") {
  struct Stops {
    int count = 0, ticks = 0;
    bool was_held = false;
  };
  const auto stops_with = [](const std::string& hysteresis) {
    const TreeRunner runner("r1sim", push_cart("0", "hysteresis=\"" + hysteresis + "\"", ""));
    const NodeIndex base = runner.node("base");
    Stops stops;
    const auto count = [&](Ticker& ticker) {
      const bool held = ticker.held(base);
      stops.count += held && !stops.was_held;
      stops.ticks += held;
      stops.was_held = held;
    };
    CHECK(runner.run({.after_tick = count}).status == Status::Success);
    return stops;
  };
  const Stops none = stops_with("0"), wide = stops_with("0.03");
  CHECK(wide.count * 10 < none.count);
  CHECK(wide.ticks / wide.count > 10 * none.ticks / none.count);
}

TEST_CASE("hysteresis is refused that no error can reach", "[plugins][cart]") {
  for (const char* const hysteresis : {"-0.01", "0.05"}) {
    const TreeRunner runner("r1sim", "<HoldCart hysteresis=\"" + std::string(hysteresis) + "\"/>");
    CHECK_THAT(runner.run({}).fault, Catch::Contains("'hysteresis' must be from 0 to 'boundary'"));
  }
}

TEST_CASE("a second attempt begins at the start of the path", "[plugins][cart]") {
  const std::string push = push_cart("0", "drift=\"0\"", "path=\"1\" speed=\"0.5\"");
  const TreeRunner runner("r1sim", "<Repeat times=\"2\">" + push + "</Repeat>");
  const auto both_run = [&](Ticker& ticker) {
    if (ticker.status(runner.node("base")) != Status::Running) return;
    CHECK(ticker.status(runner.node("arms")) == Status::Running);
  };
  const TreeRunEnd end = runner.run({.after_tick = both_run});
  CHECK(end.status == Status::Success);
  CHECK(end.seconds == Approx(4).margin(0.1));
}

TEST_CASE("the same seed gives the same run", "[plugins][cart]") {
  const TreeRunner runner("r1sim", push_cart("0", "", ""));
  CHECK(runner.run({.seed = 3}).seconds == runner.run({.seed = 3}).seconds);
  CHECK(runner.run({.seed = 3}).seconds != runner.run({.seed = 4}).seconds);
}

}  // namespace
}  // namespace lockstep::host::test

// The loop and its time as a user sees it: overruns, budgets, real time. The laws of the loop
// itself are in tests/unit/runtime, on a clock that the test moves.
#include <catch2/catch.hpp>

#include "reliability/hostile_tree.h"
#include "support/json.h"

namespace lockstep::host::test {
namespace {

using nlohmann::json;
using Strings = std::vector<std::string>;

// A leaf that is late by 0.3 s in one tick, at 100 Hz.
Outcome run_late(Strings options) {
  return run_hostile({"late"}, Where::InProcess, std::move(options));
}

}  // namespace

TEST_CASE("a late tick skips deadlines, makes up for them, or ends the run") {
  const json skip = parse_json(run_late({"--json"}).out);
  CHECK(skip["overruns"] >= 1);  // a busy machine makes other ticks late, too
  CHECK(skip["skipped"] >= 29);
  const json catch_up = parse_json(run_late({"--json", "--overrun", "catch-up"}).out);
  CHECK(catch_up["overruns"] >= 4);  // the leaf needs four more ticks, all of them late
  CHECK(catch_up["skipped"] == 0);
  const Outcome fail = run_late({"--json", "--overrun", "fail"});
  CHECK(fail.code == 7);
  CHECK(parse_json(fail.out)["reason"] == "overrun");
  CHECK(parse_json(fail.out)["ticks"] == 1);
}

TEST_CASE("the summary names the worst tick and the leaf that used most of it") {
  const json worst = parse_json(run_late({"--json"}).out)["worst_tick"];
  CHECK(worst["tick"] == 0);
  CHECK(worst["leaf"] == "Main/plan/arm");
  CHECK(worst["took_s"] >= 0.3);
  CHECK(worst["leaf_took_s"] >= 0.3);
}

TEST_CASE("a leaf over its budget is named while the run goes on, and in the summary") {
  const Outcome outcome = run_late({"--json", "--tick-budget", "250"});
  CHECK(contains(outcome.err, "the leaf 'Main/plan/arm' (Misbehave of plugin 'hostile') took "));
  CHECK(contains(outcome.err, "more than the budget of 250.000 ms"));
  const json summary = parse_json(outcome.out);
  CHECK(summary["tick_budget_s"] == 0.25);
  REQUIRE(summary["over_budget"].size() == 1);
  CHECK(summary["over_budget"][0]["leaf"] == "Main/plan/arm");
  CHECK(summary["over_budget"][0]["over_budget"] >= 1);
  CHECK(summary["over_budget"][0]["max_s"] >= 0.3);
}

TEST_CASE("the budget is the period by default, and 0 is none") {
  CHECK(parse_json(run_late({"--json", "--rate", "50"}).out)["tick_budget_s"] == 0.02);
  const Outcome outcome = run_late({"--json", "--tick-budget", "0"});
  CHECK_FALSE(contains(outcome.err, "budget"));
  CHECK(parse_json(outcome.out)["over_budget"].empty());
}

TEST_CASE("a processor that there is not is refused before the first tick") {
  const Outcome outcome = run_hostile({""}, Where::InProcess, {"--cpu", "4095"});
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "4095"));
  CHECK(outcome.out.empty());
}

TEST_CASE("a recording that cannot be written is reported at once, the run stops or goes on") {
  const Strings record = {"--clock", "virtual", "--record", "/dev/full", "--json"};
  Strings stop = record;
  stop.insert(stop.end(), {"--on-record-error", "stop"});
  const Outcome going_on = run_hostile({""}, Where::InProcess, record);
  CHECK(going_on.code == 0);
  CHECK(contains(going_on.err, "cannot write '/dev/full': No space left on device"));
  CHECK(contains(going_on.out, "cannot write '/dev/full'"));
  const Outcome stopped = run_hostile({""}, Where::InProcess, stop);
  CHECK(stopped.code == 8);
  CHECK(parse_json(stopped.out)["reason"] == "recording");
}

}  // namespace lockstep::host::test

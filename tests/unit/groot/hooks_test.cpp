// The breakpoints of Groot2 in a run.
#include "groot/hooks.h"

#include <catch2/catch.hpp>

#include "run/run.h"
#include "support/tree_text.h"

namespace lockstep::host {
namespace {

constexpr auto kTickPeriod = std::chrono::milliseconds(100);

// What the loop does with a run that may be paused.
struct HookedRun {
  // Ticks until the run is paused or has ended; says how many ticks it was.
  int go_on() {
    int ticks = 0;
    take_orders();
    while (!control.is_paused() && !has_ended(status)) {
      run.set_now(now += kTickPeriod);
      status = run.tick(now);
      control.count_tick(run.ticker());
      ++ticks;
    }
    control.report_standing(control.is_paused());
    return ticks;
  }
  void take_orders() {
    control.take_orders(run.ticker(), run.blackboard());
    if (!control.is_paused()) control.report_standing(false);
  }

  // uid 1, 2 and 3
  Tree tree = test::tree_from_text("Sequence[memory=true](Wait[seconds=0.25] Wait[seconds=0.45])");
  Run run{tree, {}};
  RunControl control;
  GrootHooks hooks{tree.nodes[0].end, &control};
  Nanoseconds now{0};
  Status status = Status::Idle;
};

std::string hook(int uid, int position, bool is_once = false, bool is_enabled = true,
                 int mode = 0) {
  return R"({"enabled":)" + std::string(is_enabled ? "true" : "false") + R"(,"uid":)" +
         std::to_string(uid) + R"(,"mode":)" + std::to_string(mode) + R"(,"once":)" +
         (is_once ? "true" : "false") + R"(,"desired_status":"SKIPPED","position":)" +
         std::to_string(position) + "}";
}

std::string key(int uid, int position, const std::string& status = "SKIPPED",
                bool is_over = false) {
  return R"({"uid":)" + std::to_string(uid) + R"(,"position":)" + std::to_string(position) +
         R"(,"desired_status":")" + status + R"(","remove_when_done":)" +
         (is_over ? "true" : "false") + "}";
}

TEST_CASE("a run pauses after the tick in which a node begins, or completes") {
  HookedRun it;
  CHECK(it.hooks.insert("[" + hook(3, 0) + "," + hook(2, 1) + "]").empty());
  CHECK_FALSE(it.hooks.reached());
  CHECK(it.go_on() == 4);  // both in the same tick: once
  CHECK(it.hooks.reached() == NodeIndex{2});
  CHECK_FALSE(it.hooks.reached());
  CHECK(it.hooks.paused_at() == NodeIndex{2});
  CHECK(it.hooks.unlock(key(2, 1)).empty());  // it did not pause the run
  CHECK(it.go_on() == 0);
  CHECK(it.hooks.unlock(key(3, 0)).empty());
  CHECK(it.go_on() == 5);
  CHECK(it.status == Status::Success);
}

TEST_CASE("a breakpoint that is removed or disabled lets the run go on") {
  const auto pause = [](HookedRun& it) {
    CHECK(it.hooks.insert(hook(2, 1)).empty());
    CHECK(it.go_on() == 4);
  };
  const auto goes_on = [](HookedRun& it) { CHECK(it.go_on() > 0); };
  SECTION("removed") {
    HookedRun it;
    pause(it);
    CHECK(it.hooks.remove(key(2, 1)).empty());
    goes_on(it);
    CHECK(it.hooks.dump() == "[]");
  }
  SECTION("all removed") {
    HookedRun it;
    pause(it);
    it.hooks.remove_all();
    goes_on(it);
    CHECK(it.hooks.dump() == "[]");
  }
  SECTION("all disabled") {
    HookedRun it;
    pause(it);
    it.hooks.disable_all();
    goes_on(it);
    CHECK(
        it.hooks.dump() ==
        R"([{"desired_status":"SKIPPED","enabled":false,"mode":0,"once":false,"position":1,"uid":2}])");
  }
  SECTION("disabled") {
    HookedRun it;
    pause(it);
    CHECK(it.hooks.insert(hook(2, 1, false, false)).empty());
    goes_on(it);
  }
  SECTION("for once") {
    HookedRun it;
    pause(it);
    CHECK(it.hooks.unlock(key(2, 1, "SKIPPED", true)).empty());
    goes_on(it);
    CHECK(it.hooks.dump() == "[]");
  }
  SECTION("not disabled from the beginning") {
    HookedRun it;
    CHECK(it.hooks.insert(hook(2, 1, false, false)).empty());
    CHECK(it.go_on() == 9);
  }
}

TEST_CASE("where nobody is, a run does not pause, and one that is paused stays so") {
  HookedRun it;
  CHECK(it.hooks.insert("[" + hook(2, 0) + "," + hook(3, 0) + "]").empty());
  CHECK(it.go_on() == 1);
  it.hooks.set_absent(true);
  CHECK(it.go_on() == 0);
  CHECK(it.hooks.insert(hook(2, 1)).empty());
  it.control.give({.what = RunControl::Order::What::Resume});
  CHECK(it.go_on() == 8);
  CHECK(it.status == Status::Success);

  HookedRun back;
  CHECK(back.hooks.insert(hook(3, 0)).empty());
  back.hooks.set_absent(true);
  back.hooks.set_absent(false);
  CHECK(back.go_on() == 4);
}

TEST_CASE("a request that makes no sense changes nothing") {
  HookedRun it;
  for (
      const std::string& text :
      {hook(0, 0), hook(4, 0), hook(70'000, 0), hook(2, 2), hook(2, 0, false, true, 1),
       "[" + hook(2, 0) + "," + hook(4, 0) + "]", std::string("[1]"), std::string("{}"),
       std::string(), std::string("nonsense"), std::string(50'000, '['),
       std::string(
           R"({"enabled":1,"uid":2,"mode":0,"once":false,"desired_status":"","position":0})"),
       std::string(
           R"({"enabled":true,"uid":-1,"mode":0,"once":false,"desired_status":"","position":0})")}) {
    INFO(text.substr(0, 200));
    CHECK_FALSE(it.hooks.insert(text).empty());
  }
  std::string many = "[" + hook(2, 0);
  for (std::size_t i = 0; i < GrootHooks::kMost; ++i) many += "," + hook(2, 0);
  CHECK_FALSE(it.hooks.insert(many + "]").empty());
  CHECK(it.hooks.dump() == "[]");
  for (const std::string& text : {key(2, 0), std::string("{}"), std::string("nonsense")}) {
    CHECK_FALSE(it.hooks.remove(text).empty());
    CHECK_FALSE(it.hooks.unlock(text).empty());
  }
  CHECK(it.hooks.insert(hook(2, 0)).empty());
  CHECK(it.go_on() == 1);
  CHECK(it.hooks.unlock(key(2, 0, "SUCCESS")) ==
        "lockstep puts no other status in place of a node's: 'SKIPPED', not 'SUCCESS'");
  CHECK(it.go_on() == 0);
}

}  // namespace
}  // namespace lockstep::host

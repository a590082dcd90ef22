// The clock of a plugin as the clock of a run.
#include "leaves/plugin/contract/plugin_clock.h"

#include <catch2/catch.hpp>
#include <string_view>
#include <vector>

namespace lockstep::host {
namespace {

std::int64_t now_there = -1;

constexpr lockstep_clock kClock{sizeof(lockstep_clock), "test",
                                [](const char** why) { return *why = "it rests", false; },
                                [] { return now_there; }};

// What the run's clock is after each of these.
std::vector<std::int64_t> times(const std::vector<std::int64_t>& there) {
  PluginClock clock(kClock);
  std::vector<std::int64_t> times;
  for (const std::int64_t it : there) {
    now_there = it;
    times.push_back(clock.now().count());
  }
  return times;
}

}  // namespace

TEST_CASE("plugin clock: time passes as there, from 0, and never goes back") {
  using Times = std::vector<std::int64_t>;
  CHECK(times({100, 150, 150, 400}) == Times{0, 50, 50, 300});
  CHECK(times({-1, -1, 100, 101}) == Times{0, 0, 0, 1});
  CHECK(times({100, 150, 10, 30}) == Times{0, 50, 50, 70});  // reset
  CHECK(times({100, 150, -1, 160}) == Times{0, 50, 50, 60});
  CHECK(times({0, 5, 0, 5, 0, 5}) == Times{0, 5, 5, 10, 10, 15});  // in a loop
}

TEST_CASE("plugin clock: a wait ends at its time, or soon while the clock stands") {
  PluginClock clock(kClock);
  now_there = 0;
  clock.now();
  clock.sleep_until(std::chrono::hours(1));
  CHECK(clock.now() == Nanoseconds(0));
  now_there = 3'600'000'000'000;
  clock.sleep_until(std::chrono::hours(1));
  CHECK(clock.now() == std::chrono::hours(1));
}

TEST_CASE("plugin clock: one that does not open says why") {
  CHECK(PluginClock(kClock).open() == "it rests");
}

TEST_CASE("plugin clock: a plugin has one as an extension, or has none") {
  lockstep_plugin plugin{};
  plugin.name = "p";
  CHECK(clock_of(plugin) == nullptr);
  plugin.get_extension = [](const char* id) -> const void* {
    return std::string_view(id) == LOCKSTEP_CLOCK ? &kClock : nullptr;
  };
  CHECK(clock_of(plugin) == &kClock);
}

}  // namespace lockstep::host

// The law of resources that robots share, word by word.
#include "team/pool.h"

#include <catch2/catch.hpp>
#include <deque>
#include <string>
#include <utility>
#include <vector>

namespace lockstep::host::test::shared_pool {
namespace {

constexpr Nanoseconds kPeriod = std::chrono::milliseconds(10);
constexpr ResourceSet kA = 1, kB = 2, kBoth = 3;

// A process of a robot, and what it has said.
struct Process {
  Process(std::size_t place, std::size_t robots, std::uint64_t run)
      : member(declaration(place, robots), run), pool(member.declaration(), run) {}

  static TeamDeclaration declaration(std::size_t place, std::size_t robots) {
    TeamDeclaration it{.team = "t", .self = "r" + std::to_string(place), .others = {}};
    for (std::size_t i = 0; i < robots; ++i) {
      if (i != place) it.others.push_back("r" + std::to_string(i));
    }
    it.period = kPeriod;
    it.resources = {"a", "b"};
    it.pool_hash = 7;
    it.place = place;
    return it;
  }

  // One tick, in which it asks for this set; 0: for nothing.
  bool tick(Nanoseconds now, ResourceSet wanted) {
    member.look(now);
    pool.look(member, now);
    if (wanted == 0) pool.give_back(0);
    const bool owns = wanted != 0 && pool.ask(0, wanted);
    pool.end_tick();
    said = member.word(pool.word());
    return owns;
  }

  TeamMember member;
  TeamPool pool;
  TeamWord said;
};

struct Robots {
  explicit Robots(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) processes.emplace_back(i, count, 100 + i);
  }
  void tell(std::size_t from, std::size_t to, const TeamWord& word) {
    processes[to].member.hear(from < to ? from : from - 1, word, now);
  }
  // All tick, and then all hear each other, but for the one that is cut off.
  std::vector<bool> tick(const std::vector<ResourceSet>& wanted, std::size_t cut_off = 99) {
    now += kPeriod;
    std::vector<bool> owns;
    for (std::size_t i = 0; i < processes.size(); ++i)
      owns.push_back(processes[i].tick(now, wanted[i]));
    for (std::size_t from = 0; from < processes.size(); ++from) {
      for (std::size_t to = 0; to < processes.size(); ++to) {
        if (from != to && from != cut_off && to != cut_off) tell(from, to, processes[from].said);
      }
    }
    return owns;
  }
  std::vector<bool> ticks(int count, const std::vector<ResourceSet>& wanted,
                          std::size_t cut_off = 99) {
    std::vector<bool> owns;
    for (int i = 0; i < count; ++i) owns = tick(wanted, cut_off);
    return owns;
  }
  std::deque<Process> processes;
  Nanoseconds now{0};
};

using Owners = std::vector<bool>;

}  // namespace

TEST_CASE("a shared pool: who asks first is first, and gets what was given back") {
  Robots robots(3);
  robots.ticks(3, {0, 0, 0});
  CHECK(robots.ticks(3, {kA, 0, 0}) == Owners{true, false, false});
  CHECK(robots.ticks(3, {kA, kA, 0}) == Owners{true, false, false});
  CHECK(robots.ticks(5, {kA, kA, kA}) == Owners{true, false, false});
  CHECK(robots.ticks(4, {0, kA, kA}) == Owners{false, true, false});
  CHECK(robots.ticks(4, {kB, 0, kA}) == Owners{true, false, true});
}

TEST_CASE("a shared pool: what one waits for, no other robot gets before it") {
  Robots robots(3);
  robots.ticks(3, {0, 0, 0});
  robots.ticks(3, {kA, 0, 0});
  robots.ticks(3, {kA, kBoth, 0});
  CHECK(robots.ticks(5, {kA, kBoth, kB}) == Owners{true, false, false});
  CHECK(robots.ticks(4, {0, kBoth, kB}) == Owners{false, true, false});
}

TEST_CASE(
    "a shared pool: no robot gets anything before all were heard, nor from one that is silent") {
  Robots robots(3);
  CHECK(robots.ticks(20, {kA, kB, 0}, 2) == Owners{false, false, false});
  CHECK(robots.ticks(4, {kA, kB, 0}) == Owners{true, true, false});
  // The one that decides is cut off: who owns keeps, and no other robot gets it.
  CHECK(robots.ticks(50, {kA, kB, kB}, 0) == Owners{true, true, false});
  CHECK(robots.ticks(50, {0, kB, kA}, 0) == Owners{false, true, false});
  CHECK(robots.ticks(4, {0, kB, kA}) == Owners{false, true, true});
}

TEST_CASE("a shared pool: the next one decides when the run of the first has ended") {
  Robots robots(3);
  robots.ticks(3, {0, 0, 0});
  robots.ticks(3, {0, kA, 0});
  robots.processes[0].pool.leave();
  const TeamWord last = robots.processes[0].member.word(robots.processes[0].pool.word());
  CHECK(last.pool.has_left);
  CHECK(last.pool.decider == 1);
  const auto tick_rest = [&](ResourceSet one, ResourceSet two) {
    robots.now += kPeriod;
    const bool first = robots.processes[1].tick(robots.now, one);
    const bool second = robots.processes[2].tick(robots.now, two);
    robots.tell(1, 2, robots.processes[1].said);
    robots.tell(2, 1, robots.processes[2].said);
    return std::pair(first, second);
  };
  robots.tell(0, 1, last);
  robots.tell(0, 2, last);
  for (int i = 0; i < 5; ++i) CHECK(tick_rest(kA, kA) == std::pair(true, false));
  for (int i = 0; i < 3; ++i) tick_rest(0, kA);
  CHECK(tick_rest(0, kA) == std::pair(false, true));
}

TEST_CASE("a shared pool: an answer of an old process is not taken") {
  Robots robots(2);
  robots.ticks(3, {0, 0});
  robots.tick({0, kA});
  // The first one grants it, and is started again before the other one hears so.
  robots.now += kPeriod;
  robots.processes[0].tick(robots.now, 0);
  const TeamWord granted = robots.processes[0].said;
  REQUIRE(granted.pool.answer_count == 1);
  Process again(0, 2, 900);
  robots.now += kPeriod;
  again.tick(robots.now, kA);
  robots.tell(0, 1, again.said);
  robots.processes[1].tick(robots.now, kA);
  CHECK(robots.processes[1].said.pool.follows == 900);
  robots.tell(0, 1, granted);  // late, and now it is contested
  CHECK_FALSE(robots.processes[1].tick(robots.now + kPeriod, kA));
}

TEST_CASE("a shared pool: a process that another robot does not follow any more decides nothing") {
  Robots robots(3);
  robots.ticks(3, {0, 0, 0});
  TeamWord other = robots.processes[1].said;
  other.number += 100;
  other.pool.follows = 900;  // a second program has the name of the first robot
  robots.tell(1, 0, other);
  for (int i = 0; i < 5; ++i) {
    robots.now += kPeriod;
    robots.processes[0].tick(robots.now, 0);
    robots.tell(0, 2, robots.processes[0].said);
    CHECK_FALSE(robots.processes[2].tick(robots.now, kA));
    robots.tell(2, 0, robots.processes[2].said);
  }
}

TEST_CASE("a shared pool: what a killed process had is free after the deadline, not before") {
  Robots robots(2);
  robots.ticks(3, {0, 0});
  robots.ticks(3, {0, kA});
  Process again(1, 2, 900);
  int ticks = 0;
  for (bool owns = false; !owns; ++ticks) {
    REQUIRE(ticks < 50);
    robots.now += kPeriod;
    owns = robots.processes[0].tick(robots.now, kA);
    again.member.hear(0, robots.processes[0].said, robots.now);
    again.tick(robots.now, 0);
    robots.tell(1, 0, again.said);
  }
  CHECK(ticks > kPeriodsOfSilence);
}

}  // namespace lockstep::host::test::shared_pool

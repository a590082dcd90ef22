// The law of a team, without a network and without trees: docs/team.md.
#include "team/member.h"

#include <catch2/catch.hpp>
#include <limits>

namespace lockstep::host::test {
namespace {

using namespace std::chrono_literals;
using Where = TeamMember::Where;
using End = TeamMember::End;

constexpr Nanoseconds kPeriod = 10ms;

TeamDeclaration left_of(std::vector<std::string> others = {"right"}) {
  return {
      .team = "table", .self = "left", .others = std::move(others), .hash = 7, .period = kPeriod};
}

// A word of another member.
TeamWord word_of(std::uint64_t run, std::uint64_t number, std::uint32_t round, bool is_in = true,
                 double progress = 0, std::uint32_t passed = 0) {
  return {.run = run,
          .number = number,
          .declaration = 7,
          .round = round,
          .passed = passed,
          .is_in = is_in,
          .progress = progress,
          .period = to_seconds(kPeriod)};
}

// A member that has begun round `round`, at 0 s.
TeamMember in_round(std::uint32_t round) {
  TeamMember member(left_of(), 1);
  member.set_own(true, 0, End::None);
  member.hear(0, word_of(2, 1, round, true, 0, round - 1), 0s);
  member.look(0s);
  REQUIRE(member.round() == round);
  return member;
}

Where where(const TeamMember& member) {
  return member.known(0).where;
}

}  // namespace

TEST_CASE("a member begins no round before all others were heard") {
  TeamMember member(left_of({"right", "third"}), 1);
  member.set_own(true, 0, End::None);
  member.look(0s);
  CHECK(where(member) == Where::Unheard);
  CHECK(member.round() == 0);
  member.hear(0, word_of(2, 1, 0), 10ms);
  member.look(10ms);
  CHECK(where(member) == Where::NotBegun);
  CHECK(member.round() == 0);
  member.hear(1, word_of(3, 1, 0), 20ms);
  member.look(20ms);
  CHECK(member.round() == 1);  // nobody knows one: it is the first
}

TEST_CASE("a new process joins the earliest round of the others") {
  TeamMember member(left_of({"right", "third"}), 1);
  member.set_own(true, 0, End::None);
  member.hear(0, word_of(2, 1, 6, true, 0, 5), 0s);
  member.hear(1, word_of(3, 1, 5, true, 0.9, 4), 0s);
  member.look(0s);
  CHECK(member.round() == 5);
  CHECK(member.known(0).where == Where::Passed);
  CHECK(member.known(1).where == Where::InRound);
  CHECK(member.known(1).progress == 0.9);
}

TEST_CASE("a process that continues a run is in the rounds of that, whatever the others do") {
  TeamMember member(left_of(), 9);
  member.resume(4, 3);
  CHECK(member.word().round == 4);
  CHECK(member.word().passed == 3);
  // The other one has not completed the third round yet, which a new process would join.
  member.hear(0, word_of(2, 1, 3, true, 0.9, 2), 10ms);
  member.set_own(true, 0.5, End::None);
  member.look(10ms);
  CHECK(member.round() == 4);
  CHECK(where(member) == Where::NotBegun);
  member.hear(0, word_of(2, 2, 4, true, 0.1, 3), 20ms);
  member.look(20ms);
  CHECK(where(member) == Where::InRound);
  CHECK(member.known(0).progress == 0.1);
}

TEST_CASE("what was heard of an earlier round opens nothing") {
  TeamMember member = in_round(1);
  member.set_own(false, 0, End::Success);
  member.set_own(true, 0, End::None);  // the second round
  CHECK(member.round() == 2);
  member.hear(0, word_of(2, 2, 1, true, 1), 0s);
  member.look(10ms);
  CHECK(where(member) == Where::NotBegun);
  member.hear(0, word_of(2, 3, 2, false, 0, 1), 20ms);
  member.look(20ms);
  CHECK(where(member) == Where::NotBegun);
  member.hear(0, word_of(2, 4, 2, true, 0.5, 1), 30ms);
  member.look(30ms);
  CHECK(where(member) == Where::InRound);
}

TEST_CASE("a failure or a halt ends no round") {
  TeamMember member = in_round(3);
  member.set_own(false, 0, End::Other);
  CHECK(member.round() == 3);
  CHECK_FALSE(member.word().is_in);
  member.set_own(true, 0, End::None);
  CHECK(member.round() == 3);
  CHECK(member.word().passed == 0);
}

TEST_CASE("one who has completed the round counts so, whatever it does next") {
  TeamMember member = in_round(2);
  member.hear(0, word_of(2, 2, 3, true, 0.1, 2), 0s);
  member.look(0s);
  CHECK(where(member) == Where::Passed);
  CHECK(member.round() == 2);
}

TEST_CASE("one who has completed the round counts so for ever, also where it was heard late") {
  TeamMember member = in_round(2);
  member.hear(0, word_of(2, 2, 3, false, 0, 2), 10ms);
  member.look(10s);
  CHECK(where(member) == Where::Passed);
}

TEST_CASE("a deadline is at least two periods of the slowest member") {
  TeamDeclaration hasty = left_of();
  hasty.deadline = 1ms;
  TeamMember member(hasty, 1);
  member.hear(0, word_of(2, 1, 1), 0s);
  member.look(20ms);
  CHECK(where(member) == Where::NotBegun);
  member.look(21ms);
  CHECK(where(member) == Where::Silent);
}

TEST_CASE("all go on in the round that a new process has joined instead of this one") {
  TeamMember member = in_round(2);
  member.hear(0, word_of(9, 1, 3, true, 0.1), 0s);  // it has completed none itself
  member.look(0s);
  CHECK(member.round() == 3);
  CHECK(where(member) == Where::InRound);
}

TEST_CASE("a member is silent after five periods of the slowest, or after the deadline") {
  TeamMember member = in_round(1);
  member.look(50ms);
  CHECK(where(member) == Where::InRound);
  member.look(51ms);
  CHECK(where(member) == Where::Silent);
  CHECK(member.known(0).age == 51ms);
  member.hear(0, word_of(2, 2, 1, true, 0.2), 60ms);
  member.look(60ms);
  CHECK(where(member) == Where::InRound);

  TeamDeclaration patient = left_of();
  patient.deadline = 1s;
  TeamMember other(patient, 1);
  other.hear(0, word_of(2, 1, 1), 0s);
  other.look(1s);
  CHECK(where(other) == Where::NotBegun);
  other.look(1001ms);
  CHECK(where(other) == Where::Silent);

  TeamMember of_slow = in_round(1);
  TeamWord slow = word_of(2, 2, 1);
  slow.period = 1;
  of_slow.hear(0, slow, 0s);
  of_slow.look(5s);
  CHECK(where(of_slow) == Where::InRound);
}

TEST_CASE("two robots of one name are seen, and a robot that was started again is not one of two") {
  TeamMember member = in_round(1);
  member.hear(0, word_of(3, 1, 1, true, 0.1), 10ms);
  member.look(10ms);
  CHECK(where(member) == Where::InRound);  // it was started again
  member.hear(0, word_of(2, 2, 1, true, 0.2), 20ms);
  member.look(20ms);
  CHECK(where(member) == Where::Contested);
  member.hear(0, word_of(3, 2, 1, true, 0.1), 30ms);
  member.look(80ms);
  CHECK(where(member) == Where::Contested);
  member.hear(0, word_of(3, 3, 1, true, 0.1), 85ms);  // the other one was switched off
  member.look(90ms);
  CHECK(where(member) == Where::InRound);
}

TEST_CASE("another robot with the own name is seen") {
  TeamMember member = in_round(1);
  member.hear_own_name(word_of(1, 5, 1), 0s);
  member.look(0s);
  CHECK_FALSE(member.is_contested());  // its own word
  member.hear_own_name(word_of(8, 1, 1), 10ms);
  member.look(10ms);
  CHECK(member.is_contested());
  member.look(61ms);
  CHECK_FALSE(member.is_contested());
}

TEST_CASE("a member whose tree declares the team in another way is a stranger") {
  TeamMember member = in_round(1);
  TeamWord word = word_of(3, 1, 1);
  word.declaration = 8;
  member.hear(0, word, 0s);
  member.look(0s);
  CHECK(where(member) == Where::Stranger);
}

TEST_CASE("what makes no sense is not heard, and a run that takes back what it said is contested") {
  TeamMember member = in_round(2);
  member.hear(0, word_of(2, 2, 2, true, 0.25, 1), 0s);
  const double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double progress : {kNan, -0.1, 1.1, HUGE_VAL}) {
    member.hear(0, word_of(2, 9, 2, true, progress, 1), 40ms);
    member.look(40ms);
    CHECK(member.known(0).age == 40ms);
    CHECK(where(member) == Where::InRound);
  }
  member.look(60ms);
  CHECK(where(member) == Where::Nonsense);
  CHECK(member.known(0).progress == 0.25);
  TeamMember other(left_of(), 1);
  other.hear(0, word_of(2, 1, 1, true, kNan), 0s);
  other.look(0s);
  CHECK(where(other) == Where::Nonsense);
  other.look(60ms);
  CHECK(where(other) == Where::Unheard);
  TeamWord word = word_of(2, 9, 2, true, 0.5, 1);
  word.period = kNan;
  member.hear(0, word, 40ms);
  member.hear(0, word_of(2, 9, 2, true, 0.5, 2), 40ms);  // it does a round that it has completed
  member.look(40ms);
  CHECK(member.known(0).age == 40ms);
  member.hear(0, word_of(2, 9, 2, true, 0.5, 0), 40ms);
  member.look(40ms);
  CHECK(where(member) == Where::Contested);
}

TEST_CASE("an older word of a run changes nothing") {
  TeamMember member = in_round(1);
  member.hear(0, word_of(2, 5, 1, true, 0.5), 10ms);
  member.hear(0, word_of(2, 4, 1, true, 0.9), 20ms);
  member.look(20ms);
  CHECK(member.known(0).progress == 0.5);
  CHECK(member.known(0).age == 10ms);
}

}  // namespace lockstep::host::test

// What people are told of questions and their answers.
#include "record/live/open_questions.h"

#include <catch2/catch.hpp>

#include "run/live_moments.h"
#include "support/scripted_run.h"

namespace lockstep::host {
namespace {

constexpr NodeIndex kAsk = 1;

struct Asking {
  test::ScriptedRun run{"Repeat[times=2](Ask[text=Where?])", ""};
  const Shape shape = shape_of(run.tree());
  LiveMoments moments{run.tree()};
  std::vector<std::string> told;
  OpenQuestions questions{shape, [this](const std::string& line) { told.push_back(line); }, [] {}};
  std::uint32_t next = 0;

  // A process that is cut has no part in it.
  void tick(bool is_told) {
    const Nanoseconds time = next * std::chrono::milliseconds(100);
    run.tick(time);
    const Moment& moment = moments.after_tick(run.ticker(), next++, time);
    if (is_told) questions.after_tick(moment, {});
  }
  void answer() {
    REQUIRE(run.ticker().answer(kAsk, {.option = 0, .text = "yes", .who = "maria"}, next));
  }
};

}  // namespace

TEST_CASE("questions: an answer is told when its node takes it, once, also over a cut") {
  for (const bool is_cut : {false, true}) {
    Asking it;
    it.tick(!is_cut);
    it.answer();
    for (int tick = 0; tick < 3; ++tick) it.tick(true);
    std::vector<std::string> expected{"Test/Repeat/Ask: yes (by maria)",
                                      "Test/Repeat/Ask asks: Where? (yes, no)"};
    if (!is_cut) expected.insert(expected.begin(), expected.back());
    CHECK(it.told == expected);
    CHECK(it.questions.now().size() == 1);
  }
}

}  // namespace lockstep::host

#include "judge/summary/repeated_halts.h"
#include "run/shape_of.h"

#include <catch2/catch.hpp>

#include "unit/recording/watched_run.h"

namespace lockstep::host {
namespace {

using test::WatchedRun;

struct Told {
  std::vector<std::string> warnings, notes;
};

Told told_of(const std::string& tree, const std::string& leaves, std::uint64_t ticks,
             Nanoseconds period = std::chrono::milliseconds(10)) {
  Told told;
  WatchedRun run(tree, leaves);
  run.start.period = period;
  RepeatedHalts halts(shape_of(run.run.tree()), [&](NodeIndex, const std::string& warning) {
    told.warnings.push_back(warning);
  });
  run.watch({&halts}, ticks);
  Summary summary;
  halts.add_to(summary);
  told.notes = summary.notes;
  return told;
}

constexpr const char* kFlickering = "Fallback(Sequence(c a) AlwaysRunning)";
constexpr const char* kFlickers = "c=SFSFSFSFSFSFSFSFSFSFSFSFSFSFSFSFSFSFSFSF a=R";

TEST_CASE("an action that is started and halted ten times in a second is named once") {
  CHECK(told_of(kFlickering, kFlickers, 19).warnings.empty());
  const Told told = told_of(kFlickering, kFlickers, 40);
  REQUIRE(told.warnings.size() == 1);
  CHECK(told.warnings[0].starts_with(
      "the action 'Test/Fallback/Sequence/a' was started and halted 10 times in 0.18 s, the last "
      "time when 'Test/Fallback/Sequence/c' returned failure."));
  REQUIRE(told.notes.size() == 1);
  CHECK(told.notes[0] ==
        "the action 'Test/Fallback/Sequence/a' was started and halted 20 times, and 10 times "
        "within 1 s");
}

TEST_CASE("ten halts in more than a second are no warning, nor is an action that completes") {
  CHECK(told_of(kFlickering, kFlickers, 40, std::chrono::milliseconds(60)).warnings.empty());
  CHECK(told_of("KeepRunningUntilFailure(a)", "a=RSRSRSRSRSRSRSRSRSRSRSRSRSRSRSRSRSRS", 36)
            .warnings.empty());
}

TEST_CASE("where nothing beside the action decides, the node that has halted it is named") {
  const Told told = told_of("Repeat(ForceSuccess(Timeout[seconds=.015](a)))", "a=R", 200);
  REQUIRE(told.warnings.size() == 1);
  CHECK(told.warnings[0].find("the last time by 'Test/Repeat/ForceSuccess/Timeout'.") !=
        std::string::npos);
}

}  // namespace
}  // namespace lockstep::host

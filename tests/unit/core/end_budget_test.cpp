#include "base/core/end_budget.h"

#include <catch2/catch.hpp>

namespace lockstep::host::test {

using namespace std::chrono_literals;

TEST_CASE("before the last halt, and without a limit, everybody waits as long as he wants") {
  EndBudget none(std::nullopt);
  none.begin();
  EndBudget later(1s);
  for (const EndBudget* budget : {&none, &later}) {
    CHECK_FALSE(budget->rest());
    CHECK_FALSE(budget->share());
    CHECK(budget->share(5s) == 5s);
    CHECK(budget->note().empty());
  }
}

TEST_CASE("a share leaves half of the time to those who come after") {
  EndBudget budget(1h);
  budget.begin();
  CHECK(budget.rest() > 59min);
  CHECK(budget.share() > 29min);
  CHECK(budget.share() <= 30min);
  CHECK(budget.share(5s) == 5s);
  budget.used_up_by("a browser");
  CHECK(budget.note().empty());  // there is time left
}

TEST_CASE("when the time is over everybody has a moment, and who used it up is named once") {
  EndBudget budget(0s);
  budget.begin();
  CHECK(budget.rest() == EndBudget::kLeast);
  CHECK(budget.share() == EndBudget::kLeast);
  CHECK(budget.share(5s) == EndBudget::kLeast);
  CHECK(budget.note().empty());  // by nobody
  for (const char* who : {"a browser", "the program 'grip'", "a browser"}) budget.used_up_by(who);
  CHECK(budget.note() ==
        "the end of the run took longer than --halt-limit (0 s): it waited for a browser and the "
        "program 'grip'");
}

}  // namespace lockstep::host::test

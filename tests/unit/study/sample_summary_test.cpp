#include "study/sample_summary.h"

#include <catch2/catch.hpp>

namespace lockstep::host {
namespace {

TEST_CASE("quartiles are the medians of the halves") {
  const SampleSummary odd = summarize({9, 1, 3, 7, 5});
  CHECK(odd.count == 5);
  CHECK(odd.min == 1);
  CHECK(odd.q1 == 2);  // of 1 3
  CHECK(odd.median == 5);
  CHECK(odd.q3 == 8);  // of 7 9
  CHECK(odd.max == 9);
  CHECK(odd.mean == Approx(5));

  const SampleSummary even = summarize({4, 1, 3, 2, 6, 5});
  CHECK(even.q1 == 2);
  CHECK(even.median == 3.5);
  CHECK(even.q3 == 5);
}

TEST_CASE("quartiles of few values") {
  const SampleSummary one = summarize({4});
  CHECK(one.q1 == 4);
  CHECK(one.q3 == 4);
  const SampleSummary two = summarize({4, 2});
  CHECK(two.q1 == 2);
  CHECK(two.median == 3);
  CHECK(two.q3 == 4);
  CHECK(summarize({}).count == 0);
}

}  // namespace
}  // namespace lockstep::host

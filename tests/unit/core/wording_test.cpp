#include "base/core/wording.h"

#include <catch2/catch.hpp>
#include <limits>
#include <vector>

using namespace lockstep::host;

TEST_CASE("a name has at most 256 letters in a message") {
  CHECK(brief("arm") == "arm");
  CHECK(brief(std::string(256, 'a')) == std::string(256, 'a'));
  CHECK(brief(std::string(257, 'a')) == std::string(253, 'a') + "…");
  CHECK(brief(std::string(252, 'a') + "éééééé") == std::string(252, 'a') + "…");
}

TEST_CASE("a list has at most ten names") {
  std::vector<std::string_view> names(10, "a");
  CHECK(listed(names) == "'a', 'a', 'a', 'a', 'a', 'a', 'a', 'a', 'a', 'a'");
  names.insert(names.end(), 5, "b");
  CHECK(listed(names) == "'a', 'a', 'a', 'a', 'a', 'a', 'a', 'a', 'a', 'a' and 5 more");
  CHECK(listed({}).empty());
}

TEST_CASE("a list of long names has fewer") {
  const std::string name(200, 'n');
  const std::vector<std::string_view> names(100, name);
  CHECK(listed(names) == "'" + name + "', '" + name + "' and 98 more");
}

TEST_CASE("a long chain shows its beginning and its end") {
  CHECK(chained(std::vector<std::string_view>{"a", "b", "a"}) == "a -> b -> a");
  const std::vector<std::string_view> ten = {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"};
  CHECK(chained(ten) == "0 -> 1 -> 2 -> 3 -> 4 -> 5 -> 6 -> 7 -> 8 -> 9");
  std::vector<std::string_view> twelve = ten;
  twelve.insert(twelve.begin() + 6, {"x", "y"});
  CHECK(chained(twelve) == "0 -> 1 -> 2 -> 3 -> 4 -> … (2 more) … -> y -> 6 -> 7 -> 8 -> 9");
}

TEST_CASE("a number has four digits, and all that stand before the point") {
  CHECK(rounded(0) == "0");
  CHECK(rounded(0.25) == "0.25");
  CHECK(rounded(35.8781) == "35.88");
  CHECK(rounded(0.0749022) == "0.0749");
  CHECK(rounded(-123456.7) == "-123457");
  CHECK(rounded(1e300) == "1e+300");
  CHECK(rounded(std::numeric_limits<double>::infinity()) == "inf");
}

TEST_CASE("numbers that differ by a range have three digits of it") {
  CHECK(rounded_within(37.8036, 7.865) == "37.80");
  CHECK(rounded_within(37, 7.865) == "37");
  CHECK(rounded_within(37.8036, 0.7865) == "37.804");
  CHECK(rounded_within(0.401809, 0.003) == "0.40181");
  CHECK(rounded_within(4.4, 0.5) == "4.4");
  CHECK(rounded_within(1234567, 100000) == "1234567");
  CHECK(rounded_within(-0.0001, 20) == "0.0");
  CHECK(rounded_within(0.1, 0) == "0.1");
  CHECK(rounded_within(123.4567, 0) == "123.457");
}

TEST_CASE("one tick, two ticks") {
  CHECK(counted(0, "tick") == "0 ticks");
  CHECK(counted(1, "tick") == "1 tick");
  CHECK(counted(2, "tick") == "2 ticks");
}

TEST_CASE("how many children a node has") {
  constexpr auto kAny = std::numeric_limits<std::uint32_t>::max();
  CHECK(arity_text(1, 1) == "exactly one child");
  CHECK(arity_text(1, kAny) == "one or more children");
  CHECK(arity_text(2, 2) == "exactly 2 children");
  CHECK(arity_text(2, kAny) == "2 or more children");
  CHECK(arity_text(1, 4) == "1 to 4 children");
}

// The short way of a script that only changes a number gives what the whole program gives.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "language/expression/change.h"
#include "language/expression/expression.h"
#include "support/script_board.h"

using namespace lockstep::host;
using namespace lockstep::host::test;

namespace {

std::optional<Change> change_of(const std::string& script) {
  const auto code = Expression::parse(script);
  REQUIRE(code);
  return only_change(code->program().code);
}

const std::vector<Value>& numbers() {
  constexpr auto kExact = std::int64_t{1} << 53;
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  static const std::vector<Value> list{std::int64_t{0},
                                       std::int64_t{7},
                                       std::int64_t{-3},
                                       kExact,
                                       kExact - 1,
                                       1 - kExact,
                                       std::numeric_limits<std::int64_t>::max(),
                                       0.0,
                                       -0.0,
                                       2.5,
                                       -1e300,
                                       1e308,
                                       kEndless,
                                       -1.0 / 3,
                                       4.0,
                                       true,
                                       std::string("5"),
                                       NoValue{}};
  return list;
}

}  // namespace

TEST_CASE("a script that only changes a number is known by its code") {
  for (const char* script : {"n = n + 1", "n = n * 0.5", "n -= 2", "n /= 3", "(n) = n - 1"}) {
    CAPTURE(script);
    CHECK(change_of(script));
  }
  for (const char* script : {"n := n + 1", "n = m + 1", "n = 1 + n", "n = n + m",
                             "n = n + 1; m = 2", "n = n + 'a'", "n = 2", "n + 1", "n += m",
                             "n = n & 1", "n = -n", "n = n < 1", "n = n + 9007199254740992"}) {
    CAPTURE(script);
    CHECK_FALSE(change_of(script));
  }
}

TEST_CASE("a change by the short way is what the whole program makes of the entry") {
  std::size_t taken = 0;
  for (const Value& before : numbers()) {
    for (const char* by : {"0", "1", "3", "0.5", "1e300", "9007199254740991"}) {
      for (const char* form : {"n = n {} {}", "n {}= {}"}) {
        for (const char* sign : {"+", "-", "*", "/"}) {
          const std::string script = fmt::format(fmt::runtime(form), sign, by);
          ScriptBoard board;
          Entry entry = board.any("n", before);
          const bool is_strict = std::holds_alternative<double>(before);
          if (is_strict) entry = board.declare("n", ValueType::Double, before, Typing::Strict);
          const auto change = change_of(script);
          REQUIRE(change);
          if (!apply(*change, entry)) continue;
          ++taken;
          INFO(shown(before) << "  " << script);
          CHECK(board.run(script).error.empty());
          CHECK(shown(board.at("n").value()) == shown(entry.value()));
          CHECK(board.at("n").value().index() == entry.value().index());
          CHECK(board.at("n").writes() == entry.writes());
        }
      }
    }
  }
  CHECK(taken > 300);
}

// What is said of a property with a mistake, and at which column.
#include <catch2/catch.hpp>

#include "language/property/property.h"

namespace lockstep::host::test {
namespace {

struct Row {
  const char* text;
  std::size_t column;  // from 1
  const char* message;
  const char* hint;  // "": any
};

PropertyNames names() {
  return {
      .paths = {"Main", "Main/left", "Main/left/arm", "Main/right", "Main/right/arm", "Main/base"},
      .entries = {{"place", "string", true},
                  {"count", "int", true},
                  {"on", "bool", true},
                  {"S/x", "int", true},
                  {"S/x", "int", true}}};
}

}  // namespace

TEST_CASE("each mistake in a property is reported at its column") {
  constexpr Row kRows[] = {
      {"", 1, "expected what holds in a tick instead of the end", ""},
      {"never", 6, "expected what holds in a tick instead of the end", ""},
      {"never bse.running", 7, "no node 'bse'", "did you mean 'base'?"},
      {"never {S/x} == 1", 7, "'S/x' is the key of 2 entries", "give the SubTrees different names"},
      {"never left/amr.running", 7, "no node 'left/amr'", "did you mean 'left/arm'?"},
      {"never arm.running", 7, "'arm' is the end of 2 paths",
       "write more of the one that is meant: 'left/arm', 'right/arm'"},
      {"never base.runing", 12, "a node has no 'runing'", "did you mean 'running'?"},
      {"never base", 7, "'base' is not about a tick", ""},
      {"base.running", 13,
       "expected 'and', 'or', 'leads to', 'only after', 'at most' or 'until' instead of the end",
       ""},
      {"never base.running base.idle", 20, "expected the end instead of 'base.idle'", ""},
      {"after base.running", 19, "expected 'and', 'or' or 'never' instead of the end", ""},
      {"after base.running always base.idle", 20,
       "expected 'and', 'or' or 'never' instead of 'always'", ""},
      {"base.running leads base.idle", 20, "expected 'to' instead of 'base.idle'", ""},
      {"base.running leads to base.idle within", 39,
       "expected a number of ticks instead of the end", ""},
      {"base.running leads to base.idle within 5", 41, "expected 'ticks' instead of the end", ""},
      {"base.running leads to base.idle within 2.5 ticks", 40, "'2.5' is not a number of ticks",
       ""},
      {"base.held at most -1 ticks", 19, "'-1' is not a number of ticks", ""},
      {"base.held at 5 ticks", 14, "expected 'most' instead of '5'", ""},
      {"never base.progress", 20, "expected a relation: < <= == != >= > instead of the end", ""},
      {"never base.progress < 1.5", 23, "progress is never 1.5", "it is from 0 to 1"},
      {"never base.progress < base", 23, "expected a number from 0 to 1 instead of 'base'", ""},
      {"never (base.running", 20, "expected ')', 'and' or 'or' instead of the end", ""},
      {"never base.running && base.idle", 20, "unexpected '&&'", "write 'and'"},
      {"never !base.running", 7, "unexpected '!'", "write 'not'"},
      {"never {plaec} == 'kitchen'", 7, "no entry 'plaec'", "did you mean 'place'?"},
      {"never {place} == kitchen", 18,
       "expected a number, true, false or a text in quotes instead of 'kitchen'", ""},
      {"never {place} < 'kitchen'", 17, "only numbers are less or greater", ""},
      {"never {place} == 3", 18, "'place' is of the type string", "write the text in quotes: '3'"},
      {"never {count} == '3'", 18, "'count' is of the type int", "compare it with a number"},
      {"never {on} == 1", 15, "'on' is of the type bool", "compare it with true or false"},
      {"never 'base.running", 7, "the name that begins with ' does not end", "close it with '"},
      {"never 'base'", 13,
       "expected a field, as .running, behind the name of a node instead of "
       "the end",
       ""},
      {"never and", 7, "expected what holds in a tick instead of 'and'", ""},
      {"never base.progress < 1e999", 23, "1e999 is too large", ""},
  };
  for (const Row& row : kRows) {
    INFO(row.text);
    const auto property = Property::parse(row.text, names());
    REQUIRE_FALSE(property);
    CHECK(property.error().message == row.message);
    CHECK(property.error().offset + 1 == row.column);
    if (*row.hint != '\0') CHECK(property.error().hint == row.hint);
  }
}

TEST_CASE("a path with other characters needs quotes, and an error says so") {
  const PropertyNames names = {.paths = {"Main/go%2Fhome", "Main/pick up", "Main/v1.0%2Fb"},
                               .entries = {}};
  constexpr Row kRows[] = {
      {"never go/home.failure", 7, "no node 'go/home'", "write 'go%2Fhome', with the quotes"},
      {"never 'go/home'.failure", 7, "no node 'go/home'", "write 'go%2Fhome', with the quotes"},
      {"never 'pick_up'.failure", 7, "no node 'pick_up'", "write 'pick up', with the quotes"},
      {"never go%2Fhome.failure", 7, "the path 'go%2Fhome' needs quotes",
       "write 'go%2Fhome'.running"},
      {"never Main/pick up.failure", 7, "the path 'Main/pick up' needs quotes",
       "write 'Main/pick up'.running"},
      {"never v1.0%2Fb.failure", 7, "the path 'v1.0%2Fb' needs quotes", "write 'v1.0%2Fb'.running"},
  };
  for (const Row& row : kRows) {
    INFO(row.text);
    const auto property = Property::parse(row.text, names);
    REQUIRE_FALSE(property);
    CHECK(property.error().message == row.message);
    CHECK(property.error().offset + 1 == row.column);
    CHECK(property.error().hint == row.hint);
  }
}

TEST_CASE("parentheses may be nested, but not without end") {
  const auto nested = [](std::size_t depth) {
    return "never " + std::string(depth, '(') + "base.running or base.idle and base.held" +
           std::string(depth, ')');
  };
  CHECK(Property::parse(nested(Formula::kDeepest), names()));
  CHECK_FALSE(Property::parse(nested(Formula::kDeepest + 1), names()));
  CHECK_FALSE(Property::parse(nested(1'000'000), names()));
}

TEST_CASE("the deepest formula keeps what its outermost part has found") {
  const auto property = [](const std::string& first) {
    std::string text = "never " + first + " or base.idle and (";
    for (std::size_t depth = 1; depth < Formula::kDeepest; ++depth) {
      text += "base.idle or base.running and (";
    }
    return Property::parse(
        text + "base.idle or base.idle and base.idle" + std::string(Formula::kDeepest, ')'),
        names());
  };
  const SeenNode running{.status = Status::Running, .ticked = true};
  const std::vector<SeenNode> nodes{running};
  const auto yes = property("base.running"), no = property("base.idle");
  REQUIRE(yes);
  REQUIRE(no);
  CHECK(yes->step(nullptr, {.nodes = nodes}) == PropertyVerdict::Violated);
  CHECK(no->step(nullptr, {.nodes = nodes}) == PropertyVerdict::Open);
}

}  // namespace lockstep::host::test

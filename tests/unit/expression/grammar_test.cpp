// What is a script, and where it is wrong.
#include <catch2/catch.hpp>
#include <string>

#include "language/expression/expression.h"
#include "language/expression/reading_uses.h"
#include "support/script_board.h"

using namespace lockstep::host;
using namespace lockstep::host::test;

namespace {

std::string value_of(const std::string& script) {
  ScriptBoard board;
  board.any("a", std::int64_t{2});
  board.any("b", std::int64_t{3});
  const ScriptRun run = board.run(script);
  return run.error.empty() ? shown(run.value) : run.error;
}

}  // namespace

TEST_CASE("operators bind as the grammar of scripts says") {
  struct Row {
    std::string script, value;
  };
  const Row rows[] = {
      {"1+2*3", "7.0"},
      {"(1+2)*3", "9.0"},
      {"8-4-2", "2.0"},
      {"8/4/2", "1.0"},
      {"8/4*2", "4.0"},
      {"-2*3", "-6.0"},
      {"2*-3", "-6.0"},
      {"2--3", "5.0"},
      {"- - 2", "2.0"},
      {"!!5", "1.0"},
      {"!1+1", "1.0"},  // (!1)+1
      {"~1", "-2.0"},
      {"-~1", "2.0"},
      {"1+2..'a'", "'3.000000a'"},
      {"'a'..1..2", "'a12'"},
      {"65..'a'", "'65a'"},
      {"1.5..'a'", "'1.500000a'"},
      {"6&3+1", "4.0"},  // 6&(3+1)
      {"1|6&2", "3.0"},  // 1|(6&2)
      {"1|2^2", "1.0"},  // (1|2)^2, from the left
      {"4^1|1", "5.0"},
      {"1<2&3", "1.0"},  // 1<(2&3)
      {"1<2<3", "1.0"},
      {"3>2>1", "1.0"},
      {"3>2>2", "0.0"},
      {"1<2==2", "1.0"},  // a chain, not (1<2)==2
      {"1==1==1", "1.0"},
      {"2==2==1", "0.0"},
      {"1==1&&2==2", "1.0"},
      {"1||0&&0", "1.0"},  // 1||(0&&0)
      {"1?2:3", "2"},
      {"0?2:3", "3"},
      {"0?1:0?2:3", "3"},
      {"1?0?4:5:6", "5"},
      {"1==1?'y':'n'", "'y'"},
      {"0||1?2:3", "2"},
      {"a", "2"},
      {"a=5", "5"},
      {"c:=d:=4", "4"},
      {"c:=1?2:3", "2"},
      {"1?c:=7:0", "7"},
      {"(c:=6)+1", "7.0"},
      {"(a)=4", "4"},
      {"((a))+=4", "6"},
      {"a:=1 b:=5", "5"},
      {"a:=1;b:=5;", "5"},
      {"a:=1;;; b:=5 ;;", "5"},
      {"1 2 3", "3"},
      {"1'a'", "'a'"},
      {"1 -2", "-1.0"},
      {"1;-2", "-2.0"},
      {"a(b)", "3"},
      {" \t\r\n1\n", "1"},
      {"true", "1.0"},
      {"false", "0.0"},
      {"0x1F", "31"},
      {"0xff", "255"},
      {"007", "7"},
      {"9223372036854775807", "9223372036854775807"},
      {"0x7fffffffffffffff", "9223372036854775807"},
      {"1e3", "1000.0"},
      {"1.5e-1", "0.15"},
      {"2.5E+1", "25.0"},
      {"1e-999", "0.0"},
      {"0.0e999", "0.0"},
      {"''", "''"},
      {"'a\nb'", "'a\nb'"},
      {"\"it's\"", "'it's'"},
      {"'\\n'", "'\\n'"},
      {"'a;b:=1'", "'a;b:=1'"},
  };
  for (const Row& row : rows) {
    INFO(row.script);
    CHECK(value_of(row.script) == row.value);
  }
}

TEST_CASE("what is not a script is refused, with the place and a hint") {
  struct Row {
    std::string script;
    std::size_t offset;
    std::string message, hint;
  };
  const std::string value =
      "a value is a number, a text in quotes, true, false or the name of an entry";
  const std::string character = "texts are in quotes; names have letters from a to z, digits and _";
  const std::string range = "whole numbers go up to 9223372036854775807";
  const Row rows[] = {
      {"", 0, "the script is empty", "write an expression: battery > 20"},
      {" \n", 0, "the script is empty", "write an expression: battery > 20"},
      {" ;a", 1, "a script does not begin with ';'", "remove it"},
      {"a >", 3, "a value is missing at the end", value},
      {"a > ;", 4, "a value is missing before ';'", value},
      {"a > > b", 4, "a value is missing before '>'", value},
      {"a + 1)", 5, "unexpected ')'", "a value, or a '(' before it, is missing"},
      {"(a + 1", 6, "')' is missing at the end", "the '(' in column 1 is not closed"},
      {"a+(b 1)", 5, "')' is missing before '1'", "the '(' in column 3 is not closed"},
      {"()", 1, "unexpected ')'", "a value, or a '(' before it, is missing"},
      {"a ? 1", 5, "':' is missing at the end",
       "the '?' in column 3 needs both values: condition ? value : other"},
      {"a ? 1; 2", 5, "':' is missing before ';'",
       "the '?' in column 3 needs both values: condition ? value : other"},
      {"a ? : 1", 4, "a value is missing before ':'", value},
      {"a := ", 5, "a value is missing at the end", value},
      {"a % 2", 2, "unexpected '%'", character},
      {"a[0]", 1, "unexpected '['", character},
      {"höhe > 2", 1, "unexpected 'ö'", character},
      {"a > 'open", 4, "the text that begins with ' does not end", "close it with '"},
      {"a > \"open'", 4, "the text that begins with \" does not end", "close it with \""},
      {".5", 0, "a number does not begin with a point", "write 0.5; '..' joins texts"},
      {"5.", 0, "'5.' is not a number", "write digits after the point: 5.0"},
      {"1.e3", 0, "'1.e3' is not a number", "write digits after the point: 5.0"},
      {"a+1f", 2, "'1f' is not a number", ""},
      {"1_0", 0, "'1_0' is not a number", ""},
      {"1e", 0, "'1e' is not a number", ""},
      {"0x", 0, "'0x' is not a number", "a hexadecimal number is 0x and digits from 0 to f"},
      {"0xg1", 0, "'0xg1' is not a number", "a hexadecimal number is 0x and digits from 0 to f"},
      {"9223372036854775808", 0, "9223372036854775808 is too large", range},
      {"0x8000000000000000", 0, "0x8000000000000000 is too large", range},
      {"1e999", 0, "1e999 is too large", "numbers go up to about 1.8e308"},
      {"+1", 0, "a value is missing before '+'", value},
      {"a ! b", 4, "", ""},  // two expressions: a, and !b
      {"progress(arm/lift#2) >= 0.5", 0, "", ""},
      {"arm.progress >= 0.5", 3, "unexpected '.'",
       "a script reads a node as progress(NODE), status(NODE), held(NODE)"},
      {"progress ( 'move (left)' )", 0, "", ""},
      {"progress > 1", 0, "", ""},  // an entry
      {"status(a) == RUNNING && status(a) != idle || status(a) == status(b)", 0, "", ""},
      {"owner(dock) == none", 0, "", ""},
      {"progress()", 0, "'progress()' does not name a node or a pool",
       "write a node: progress(arm)"},
      {"owner( )", 0, "'owner()' does not name a node or a pool", "write a resource: owner(dock)"},
      {"held(a", 0, "')' is missing after 'held('", "write held(arm), or the name in quotes"},
      {"held('a)", 0, "')' is missing after 'held('", "write held(arm), or the name in quotes"},
      {"status(a) == runing", 13, "'runing' is no status", "did you mean 'running'?"},
      {"owner(a) != nobody", 12, "'nobody' is no owner",
       "compare with none, or with the path of a UseResources in quotes"},
  };
  for (const Row& row : rows) {
    INFO(row.script);
    const auto script = Expression::parse(row.script);
    REQUIRE(script.has_value() == row.message.empty());
    if (script) continue;
    CHECK(script.error().message == row.message);
    CHECK(script.error().hint == row.hint);
    CHECK(script.error().offset == row.offset);
  }
}

TEST_CASE("a script may be long but not deep") {
  const auto repeated = [](const std::string& part, std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += part;
    return text;
  };
  constexpr std::size_t kMany = 1 << 20;
  for (const std::string part : {"(", "!", "-", "a:=", "1?", "1?1:", "1||1&&1==1|1&1+1*("}) {
    INFO(part);
    const auto deep = Expression::parse(repeated(part, kMany) + "1");
    REQUIRE_FALSE(deep.has_value());
    CHECK(deep.error().message == "the script is nested more than 256 levels deep");
  }
  CHECK(value_of(repeated("(", 200) + "5" + repeated(")", 200)) == "5");
  CHECK(value_of("1" + repeated("+1", kMany)) == "1048577.0");
  CHECK(value_of("1" + repeated("<=1", kMany)) == "1.0");
  CHECK(value_of(repeated("a;", kMany)) == "2");
}

TEST_CASE("a script tells the entries that it uses, and how") {
  const auto script = Expression::parse("x := @k + y; y += 1; z = x; _w2 == x");
  REQUIRE(script.has_value());
  const auto names = script->names();
  REQUIRE(std::vector<std::string>(names.begin(), names.end()) ==
          std::vector<std::string>{"x", "@k", "y", "z", "_w2"});
  struct Row {
    bool is_read, is_assigned, is_made;
    std::size_t offset;
  };
  const Row rows[] = {{true, true, true, 0},
                      {true, false, false, 5},
                      {true, true, false, 10},
                      {false, true, false, 21},
                      {true, false, false, 28}};
  for (std::size_t i = 0; i < std::size(rows); ++i) {
    INFO(names[i]);
    CHECK(script->uses()[i].is_read == rows[i].is_read);
    CHECK(script->uses()[i].is_assigned == rows[i].is_assigned);
    CHECK(script->uses()[i].is_made == rows[i].is_made);
    CHECK(script->uses()[i].offset == rows[i].offset);
  }
  CHECK(script->remarks().empty());
}

TEST_CASE("a script tells what it reads of the run, each once") {
  const auto script =
      Expression::parse("n := progress(b/c) > 0.5 && held( a ) && progress(b/c) < n");
  REQUIRE(script.has_value());
  REQUIRE(script->names().size() == 1);
  REQUIRE(script->readings().size() == 2);
  CHECK(script->readings()[0].what == Reading::What::Progress);
  CHECK(script->readings()[0].of == "b/c");
  CHECK(script->readings()[0].offset == 14);
  CHECK(shown(script->readings()[1]) == "held(a)");
}

TEST_CASE("a script tells with which numbers it compares progress") {
  struct Row {
    const char* script;
    std::vector<std::optional<double>> uses;
  };
  const Row rows[] = {{"progress(a) >= 0.5", {.5}},
                      {"1 > progress(a)", {1}},
                      {"0.2 < progress(a) < 0.7", {.2, .7}},
                      {"(x ? 0.7 : 0.3) < progress(a)", {std::nullopt}},
                      {"(x ? progress(a) : 0.3) < 0.5", {std::nullopt}},
                      {"x ? progress(a) > 0.5 : 1", {.5}},
                      {"progress(a)", {std::nullopt}},
                      {"progress(a) - progress(b) > 0.1", {std::nullopt, std::nullopt}},
                      {"progress(a) > x", {std::nullopt}},
                      {"x := progress(a)", {std::nullopt}},
                      {"held(a) && status(a) == running", {}}};
  for (const Row& row : rows) {
    INFO(row.script);
    const auto script = Expression::parse(row.script);
    REQUIRE(script.has_value());
    const auto uses = progress_uses(*script);
    REQUIRE(uses.size() == row.uses.size());
    for (std::size_t i = 0; i < uses.size(); ++i) CHECK(uses[i].constant == row.uses[i]);
  }
}

TEST_CASE("an assignment to what is not a name is a script, but it cannot run") {
  for (const std::string text : {"a == 1 := 2", "5 = 1", "'a' := 1", "-a += 1", "(a := 1) := 2"}) {
    INFO(text);
    const auto script = Expression::parse(text);
    REQUIRE(script.has_value());
    REQUIRE(script->remarks().size() == 1);
    CHECK(script->remarks()[0].offset == 0);
    CHECK(value_of(text) == "the left side of an assignment is not a name");
    CHECK(value_of("0 ? (" + text + ") : 7") == "7");
  }
}

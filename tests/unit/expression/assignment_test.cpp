// What an assignment leaves in an entry.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <limits>
#include <string>

#include "support/script_board.h"

using namespace lockstep::host;
using namespace lockstep::host::test;

namespace {

// The entry `x` before a script, if there is one.
struct Before {
  Typing typing = Typing::Any;
  ValueType type = ValueType::String;
  Value value = {};
  bool is_present = true;
};

const Before kMissing{.is_present = false};
Before any(Value value = {}) {
  return {.value = std::move(value)};
}
Before declared(ValueType type, Value value = {}) {
  return {.typing = Typing::Declared, .type = type, .value = std::move(value)};
}
Before strict(ValueType type, Value value = {}) {
  return {.typing = Typing::Strict, .type = type, .value = std::move(value)};
}

struct AssignmentRow {
  Before before;
  std::string script;
  std::string after;  // "value*writes", or the error
};

void check(std::span<const AssignmentRow> rows) {
  for (const AssignmentRow& row : rows) {
    INFO(row.script);
    ScriptBoard board(std::make_shared<ScriptEnums>(ScriptEnums{{"RED", 2}}));
    const Before& it = row.before;
    if (it.is_present) board.declare("x", it.type, it.value, it.typing);
    board.any("list", std::vector<double>{1, 2});
    board.any("empty");
    const ScriptRun run = board.run(row.script);
    const Entry& x = board.at("x");
    if (!run.error.empty()) {
      CHECK(run.error == row.after);
      CHECK(x.value() == row.before.value);
      CHECK(x.writes() == 0);
      continue;
    }
    CHECK((x.is_present ? fmt::format("{}*{}", shown(x.value()), x.writes()) : "missing") ==
          row.after);
    if (it.is_present) CHECK(x.typing == it.typing);
  }
}

const std::string kNoEntry = "there is no entry 'x'; 'x := …' makes it";

std::string refused(const std::string& what, const std::string& type) {
  return "cannot assign " + what + " to 'x', which has the type " + type;
}

}  // namespace

TEST_CASE(":= makes a missing entry without a type, others need it") {
  const AssignmentRow rows[] = {
      {kMissing, "x := 5", "5*1"},
      {kMissing, "x := 'a'", "'a'*1"},
      {kMissing, "x := true", "1.0*1"},
      {kMissing, "x := RED", "2.0*1"},
      {kMissing, "x := list", "1;2*1"},
      {kMissing, "x = 5", kNoEntry},
      {kMissing, "x += 5", kNoEntry},
      {kMissing, "0 ? (x := 1) : 2", "missing"},
      {any(), "x = 5", "5*1"},
      {any(), "x = 'a'", "'a'*1"},
      {any(), "x = empty",
       "cannot assign to 'x': the right side is the entry 'empty' without a value"},
      {kMissing, "x := x", "cannot assign to 'x': the right side is the entry 'x' without a value"},
      {any(), "x += 1",
       "'+=' takes two numbers or two texts, not the entry 'x' without a value and 1"},
  };
  check(rows);
}

TEST_CASE("an entry keeps its kind") {
  const AssignmentRow rows[] = {
      {any(std::int64_t{1}), "x = 7", "7*1"},
      {any(std::int64_t{1}), "x = 7.0", "7*1"},
      {any(std::int64_t{1}), "x := 2.5", refused("2.5", "int")},
      {any(1.5), "x = 7", "7.0*1"},
      {any(1.5), "x = 9007199254740992",
       refused("9007199254740992 (beyond 9007199254740991)", "double")},
      {any(std::string("a")), "x = 'b'", "'b'*1"},
      {any(std::string("a")), "x = 1", refused("1", "string")},
      {any(std::string("a")), "x = list", refused("the list of double of an entry", "string")},
      {any(std::int64_t{1}), "x = list", refused("the list of double of an entry", "int")},
      {any(std::vector<double>{3}), "x = list", "1;2*1"},
      {any(std::vector<double>{3}), "x = 1", refused("1", "list of double")},
      {any(std::vector<double>{3}), "x = 'a'", refused("the text 'a'", "list of double")},
      {any(std::vector<std::int64_t>{3}), "x = list",
       refused("the list of double of an entry", "list of int")},
      {any(std::int64_t{1}), "x = '2.5'", "2.5*1"},
      {any(std::int64_t{1}), "x = 'true'", "1.0*1"},
      {any(1.5), "x = 'RED'", "2.0*1"},
      {any(1.5), "x = 'abc'", refused("the text 'abc'", "double")},
      {declared(ValueType::Int, std::int64_t{1}), "x = 7.0", "7*1"},
      {declared(ValueType::Int, std::int64_t{1}), "x := 2.5", refused("2.5", "int")},
      {declared(ValueType::Int, std::int64_t{1}), "x = 1/0", refused("inf", "int")},
      {declared(ValueType::Double, 1.0), "x = 7", "7.0*1"},
      {declared(ValueType::Bool, true), "x = false", "false*1"},
      {declared(ValueType::Bool, true), "x = 0", "false*1"},
      {declared(ValueType::Bool, true), "x = 2", "2*1"},
      {declared(ValueType::Bool, true), "x = 0.5", refused("0.5", "bool")},
      {declared(ValueType::String, std::string("a")), "x = 1", refused("1", "string")},
  };
  check(rows);
}

TEST_CASE("a text becomes a value of the declared type") {
  const AssignmentRow rows[] = {
      {declared(ValueType::Int), "x = '12'", "12*1"},
      {declared(ValueType::Int, std::int64_t{1}), "x = '12'", "12*1"},
      {declared(ValueType::Int), "x = 'a'", refused("the text 'a'", "int")},
      {declared(ValueType::Double, 1.0), "x = '2.5'", "2.5*1"},
      {declared(ValueType::Bool), "x = 'True'", "true*1"},
      {declared(ValueType::Bool, false), "x = '2'", refused("the text '2'", "bool")},
      {declared(ValueType::String), "x = 'a'", "'a'*1"},
      {declared(ValueType::String, std::int64_t{1}), "x = 'a'", "'a'*1"},
      {declared(ValueType::DoubleList), "x = '1;2.5'", "1;2.5*1"},
      {declared(ValueType::StringList), "x = 'a;b'", "a;b*1"},
  };
  check(rows);
}

TEST_CASE("an empty entry of a type takes any value but a text, which is converted, as it is") {
  const AssignmentRow rows[] = {
      {declared(ValueType::Int), "x := 3", "3*1"},
      {declared(ValueType::Int), "x := 3.0", "3.0*1"},
      {declared(ValueType::Int), "x := 3.7", "3.7*1"},
      {declared(ValueType::Double), "x := 3", "3*1"},
      {declared(ValueType::Bool), "x := true", "1.0*1"},
      {declared(ValueType::Bool), "x := 2", "2*1"},
      {declared(ValueType::Number), "x := 3", "3*1"},
      {declared(ValueType::Number), "x := 3.5", "3.5*1"},
      {declared(ValueType::Number, std::int64_t{3}), "x := 3.5", "3.5*1"},
      {declared(ValueType::String), "x := 3", "3*1"},  // and a port reads the text '3'
      {declared(ValueType::DoubleList), "x := list", "1;2*1"},
      {declared(ValueType::DoubleList), "x := 1", "1*1"},
      {declared(ValueType::Int), "x := list", "1;2*1"},
  };
  check(rows);
}

TEST_CASE("+= and its like calculate and then assign") {
  const AssignmentRow rows[] = {
      {any(std::int64_t{5}), "x += 1", "6*1"},
      {any(std::int64_t{5}), "x /= 2", refused("2.5", "int")},
      {any(std::int64_t{5}), "x *= 2", "10*1"},
      {any(1.5), "x -= 1", "0.5*1"},
      {any(std::string("a")), "x += 'b'", "'ab'*1"},
      {any(std::string("a")), "x += x", "'aa'*1"},
      {any(std::string("a")), "x += 1",
       "'+=' takes two numbers or two texts, not the text 'a' and 1"},
      {any(std::string("a")), "x -= 'a'",
       "'-=' takes two numbers, not the text 'a' and the text 'a'"},
      {any(std::int64_t{1}), "x += '1'",
       "'+=' takes two numbers or two texts, not 1 and the text '1'"},
      {any(std::int64_t{1}), "x += empty",
       "'+=' takes two numbers or two texts, not 1 and the entry 'empty' without a value"},
      {declared(ValueType::Int, std::int64_t{5}), "x /= 2", refused("2.5", "int")},
      {declared(ValueType::Bool, false), "x += 1", "true*1"},
      {any(std::int64_t{1}), "x += (x += 1)", "4*2"},
  };
  check(rows);
}

TEST_CASE("each assignment is a write, and its value is what is stored") {
  struct ValueRow {
    std::string script, value, x;
  };
  const ValueRow rows[] = {
      {"x := 1; x = 2; x += 3", "5", "5*3"},
      {"x := y := 4", "4", "4*1"},
      {"x := 1.5; x := 2", "2.0", "2.0*2"},
      {"x := 1; (x := 7.0) + x", "14.0", "7*2"},
      {"x := 'a'; x .. (x := 'b') .. x", "'abb'", "'b'*2"},
      {"x := 'a'; (x := 'b') == x", "1.0", "'b'*2"},
      {"x := 'long enough to be on the heap'; x += x; x",
       "'long enough to be on the heaplong "
       "enough to be on the heap'",
       "'long enough to be on the heaplong enough to be on the heap'*2"},
  };
  for (const ValueRow& row : rows) {
    INFO(row.script);
    ScriptBoard board;
    const ScriptRun run = board.run(row.script);
    CHECK(run.error == "");
    CHECK(shown(run.value) == row.value);
    CHECK(fmt::format("{}*{}", shown(board.at("x").value()), board.at("x").writes()) == row.x);
  }
}

TEST_CASE("a strict entry holds values of its type only") {
  const AssignmentRow rows[] = {
      {strict(ValueType::Int), "x := 3", "3*1"},
      {strict(ValueType::Int), "x = 3.0", "3*1"},
      {strict(ValueType::Int, std::int64_t{1}), "x = 2.5", refused("2.5", "int")},
      {strict(ValueType::Double, 1.0), "x = 2", "2.0*1"},
      {strict(ValueType::Double, 1.0), "x = 1/0", refused("inf", "double")},
      {strict(ValueType::Double), "x = 0/0", refused("NaN (such as 0/0)", "double")},
      {strict(ValueType::Bool, true), "x = 0", "false*1"},
      {strict(ValueType::Bool, true), "x = 2", refused("2", "bool")},
      {strict(ValueType::String), "x = 5", refused("5", "string")},
      {strict(ValueType::String), "x = ''..5", "'5'*1"},
      {strict(ValueType::Number, std::int64_t{1}), "x = 2.5", "2.5*1"},
      {strict(ValueType::Number, 1.5), "x = 2", "2.0*1"},
  };
  check(rows);
}

TEST_CASE("a script makes no text of more than a megabyte") {
  const std::string half(Evaluator::kLongestText / 2, 'a');
  const std::string error = " makes a text of more than 1048576 bytes";
  const AssignmentRow rows[] = {
      {any(half + "a"), "x := x .. x", "'..'" + error},
      {any(half + "a"), "x := x + x", "'+'" + error},
      {any(half + "a"), "x += x", "'+='" + error},
      {any(half + "a"), "x := x .. x .. 'b' == 'c'", "'..'" + error},
  };
  check(rows);
  ScriptBoard board;
  board.any("x", half);
  CHECK(board.run("x += x").error == "");
  CHECK(std::get<std::string>(board.at("x").value()).size() == Evaluator::kLongestText);
}

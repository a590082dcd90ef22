// What the operators of scripts make of numbers, texts and entries.
#include <catch2/catch.hpp>
#include <limits>
#include <string>

#include "base/blackboard/conversion.h"
#include "support/script_board.h"

using namespace lockstep::host;
using namespace lockstep::host::test;

namespace {

ScriptBoard board_of_values() {
  ScriptBoard board(std::make_shared<ScriptEnums>(ScriptEnums{{"RED", 2}, {"BLUE", 7.5}}));
  board.any("whole", std::int64_t{2});
  board.any("real", 2.0);
  board.any("half", 0.5);
  board.any("text", std::string("abc"));
  board.any("number_text", std::string("2.5kg"));
  board.any("true_text", std::string("true"));
  board.any("red_text", std::string("RED"));
  board.any("flag", true);
  board.any("large", kLargestExact + 1);
  board.any("empty");
  board.any("list", std::vector<double>{1, 2});
  return board;
}

struct ValueRow {
  std::string script, result;  // the value, or the error
};

void check_values(std::span<const ValueRow> rows) {
  for (const ValueRow& row : rows) {
    INFO(row.script);
    ScriptBoard board = board_of_values();
    const ScriptRun run = board.run(row.script);
    CHECK((run.error.empty() ? shown(run.value) : run.error) == row.result);
  }
}

}  // namespace

TEST_CASE("literals and entries keep their kind, operators give reals") {
  const ValueRow rows[] = {
      {"1", "1"},
      {"-1", "-1.0"},
      {"1+1", "2.0"},
      {"true", "1.0"},
      {"RED", "2.0"},
      {"BLUE", "7.5"},
      {"'RED'", "'RED'"},
      {"whole", "2"},
      {"flag", "1"},
      {"text", "'abc'"},
      {"list", "1;2"},
      {"empty", "none"},
      {"1;empty", "none"},
      {"missing", "there is no entry 'missing'; 'missing := …' makes it"},
      {"@missing", "there is no entry '@missing'; '@missing := …' makes it"},
      {"0 ? missing : 3", "3"},
  };
  check_values(rows);
}

TEST_CASE("arithmetic takes two numbers, + also two texts") {
  const ValueRow rows[] = {
      {"whole+half", "2.5"},
      {"7/2", "3.5"},
      {"1/0", "inf"},
      {"-1/0", "-inf"},
      {"flag*3", "3.0"},
      {"'a'+'b'", "'ab'"},
      {"text+'d'+text", "'abcdabc'"},
      {"'a'+1", "'+' takes two numbers or two texts, not the text 'a' and 1"},
      {"1+'a'", "'+' takes two numbers or two texts, not 1 and the text 'a'"},
      {"'b'-'a'", "'-' takes two numbers, not the text 'b' and the text 'a'"},
      {"'1'*2", "'*' takes two numbers, not the text '1' and 2"},
      {"1/list", "'/' takes two numbers, not 1 and the list of double of an entry"},
      {"empty+1",
       "'+' takes two numbers or two texts, not the entry 'empty' without a value and 1"},
      {"9007199254740991+0", "9007199254740991.0"},
      {"9007199254740992+0",
       "'+' takes two numbers or two texts, not 9007199254740992 (beyond 9007199254740991) and 0"},
      {"-large", "'-' takes a number, not 9007199254740992 (beyond 9007199254740991)"},
      {"large*1", "'*' takes two numbers, not 9007199254740992 (beyond 9007199254740991) and 1"},
  };
  check_values(rows);
}

TEST_CASE(".. joins texts, or a text and a number") {
  const ValueRow rows[] = {
      {"'a'..'b'", "'ab'"},
      {"'n'..1.5", "'n1.500000'"},
      {"'n'..1", "'n1'"},
      {"1..'n'", "'1n'"},
      {"'n'..(1+1)", "'n2.000000'"},
      {"'n'..1+1", "'+' takes two numbers or two texts, not the text 'n1' and 1"},
      {"'n'..-1", "'n-1.000000'"},
      {"'n'..true", "'n1.000000'"},
      {"'n'..flag", "'n1'"},
      {"'n'..1/0", "'ninf'"},
      {"''..large", "'9007199254740992'"},
      {"text..'-'..whole..'-'..half", "'abc-2-0.500000'"},
      {"'x'..(text..'y')..'z'", "'xabcyz'"},
      {"1..2", "'..' takes two texts, or a text and a number, not 1 and 2"},
      {"'a'..empty",
       "'..' takes two texts, or a text and a number, not the text 'a' and the entry 'empty' "
       "without a value"},
      {"'a'..list",
       "'..' takes two texts, or a text and a number, not the text 'a' and the list of double of "
       "an entry"},
  };
  check_values(rows);
}

TEST_CASE("bits are those of whole numbers") {
  const ValueRow rows[] = {
      {"6&3", "2.0"},
      {"6|3", "7.0"},
      {"6^3", "5.0"},
      {"6.0&3.0", "2.0"},
      {"6&flag", "0.0"},
      {"-1&255", "255.0"},
      {"6&2.5", "'&' takes two whole numbers, not 6 and 2.5"},
      {"'6'|1", "'|' takes two whole numbers, not the text '6' and 1"},
      {"1/0^1", "'^' takes two whole numbers, not inf and 1"},
      {"9223372036854775807&9223372036854775807",
       "'&' takes two whole numbers, not 9223372036854775807 (beyond 9007199254740991) and "
       "9223372036854775807 (beyond 9007199254740991)"},
      {"~0", "-1.0"},
      {"~2.9", "-3.0"},
      {"~-2.9", "1.0"},
      {"~'1'", "'~' takes a number of at most 63 bits, not the text '1'"},
      {"~(1/0)", "'~' takes a number of at most 63 bits, not inf"},
  };
  check_values(rows);
}

TEST_CASE("conditions are 0, 1 or reals that are not negative, and both sides are asked") {
  const std::string two =
      "two conditions: true, false, 0, 1 or a number that is not negative and not whole";
  const ValueRow rows[] = {
      {"1&&1", "1.0"},
      {"1&&0", "0.0"},
      {"0||0.5", "1.0"},
      {"0||0.0", "0.0"},
      {"flag&&real", "1.0"},
      {"0/0&&1", "1.0"},
      {"1||2", "'||' takes " + two + ", not 1 and 2"},
      {"0&&2", "'&&' takes " + two + ", not 0 and 2"},
      {"1||-1", "'||' takes " + two + ", not 1 and -1"},
      {"0&&-0.5", "'&&' takes " + two + ", not 0 and -0.5"},
      {"0||'True'", "1.0"},
      {"'TRUE'&&'1'", "1.0"},
      {"'false'||'False'", "0.0"},
      {"'FALSE'||'0'", "0.0"},
      {"true_text&&flag", "1.0"},
      {"1||'yes'", "'||' takes " + two + ", not 1 and the text 'yes'"},
      {"'1.0'&&1", "'&&' takes " + two + ", not the text '1.0' and 1"},
      {"0&&missing", "there is no entry 'missing'; 'missing := …' makes it"},
      {"1||missing", "there is no entry 'missing'; 'missing := …' makes it"},
      {"!0", "1.0"},
      {"!0.5", "0.0"},
      {"!-3", "0.0"},
      {"!(0/0)", "0.0"},
      {"!true_text", "0.0"},
      {"!'False'", "1.0"},
      {"!!'1'", "1.0"},
      {"!'2'", "'!' takes a number, true or false, not the text '2'"},
      {"!''", "'!' takes a number, true or false, not the text ''"},
      {"!empty", "'!' takes a number, true or false, not the entry 'empty' without a value"},
      {"-'a'", "'-' takes a number, not the text 'a'"},
  };
  check_values(rows);
}

TEST_CASE("comparisons are of texts by bytes, of numbers almost, of a number and its text") {
  const std::string operands = "two numbers or two texts, or a number and the text of one";
  const ValueRow rows[] = {
      {"'a'<'b'", "1.0"},
      {"'B'<'a'", "1.0"},
      {"'a'=='a '", "0.0"},
      {"'10'<'9'", "1.0"},
      {"'a'>='a'", "1.0"},
      {"'a'!='b'", "1.0"},
      {"1==1.0", "1.0"},
      {"1==1.0000001", "1.0"},
      {"1==1.0000002", "0.0"},
      {"1!=1.0000001", "0.0"},
      {"1<1.0000001", "0.0"},
      {"1<1.0000002", "1.0"},
      {"1.0000001<=1", "1.0"},
      {"1.0000002<=1", "0.0"},
      {"1>=1.0000001", "1.0"},
      {"1.0000001>1", "0.0"},
      {"1>=1.0000002", "0.0"},
      {"0/0<1", "1.0"},
      {"0/0>1", "1.0"},
      {"0/0<=1", "0.0"},
      {"0/0>=1", "0.0"},
      {"0/0==0/0", "0.0"},
      {"0/0!=0/0", "1.0"},
      {"1/0>1", "1.0"},
      {"'2.5kg'==2.5", "1.0"},
      {"number_text>2", "1.0"},
      {"2<number_text", "1.0"},
      {"'true'==1", "1.0"},
      {"true_text==true", "1.0"},
      {"'false'==0", "1.0"},
      {"'RED'==RED", "1.0"},
      {"red_text==2", "1.0"},
      {"red_text=='RED'", "1.0"},
      {"'TRUE'==1", "1.0"},
      {"'False'==flag", "0.0"},
      {"''<1", "'<' takes " + operands + ", not the text '' and 1"},
      {"1>=text", "'>=' takes " + operands + ", not 1 and the text 'abc'"},
      {"empty==empty",
       "'==' takes " + operands +
           ", not the entry 'empty' without a value and the entry 'empty' without a value"},
      {"list==1", "'==' takes " + operands + ", not the list of double of an entry and 1"},
      {"1<2<missing", "there is no entry 'missing'; 'missing := …' makes it"},
      {"2<1<missing", "0.0"},  // it ends at the first that does not hold
      {"'a'<text<'b'<'c'", "1.0"},
      {"'a'..'a'<'a'..'b'<'a'..'c'", "1.0"},
      {"'a'..'a'<'a'..'c'<'a'..'b'", "0.0"},
  };
  check_values(rows);
}

TEST_CASE("?: asks a number, or a text that begins with one") {
  const ValueRow rows[] = {
      {"2?'y':'n'", "'y'"},
      {"-1?'y':'n'", "'y'"},
      {"0.0?'y':'n'", "'n'"},
      {"0/0?'y':'n'", "'y'"},
      {"'1x'?'y':'n'", "'y'"},
      {"'0'?'y':'n'", "'n'"},
      {"true_text?'y':'n'", "'y'"},
      {"'False'?'y':'n'", "'n'"},
      {"text?'y':'n'", "'?' takes a number, true or false, not the text 'abc'"},
      {"empty?1:2", "'?' takes a number, true or false, not the entry 'empty' without a value"},
      {"1?whole:missing", "2"},
  };
  check_values(rows);
}

TEST_CASE("a condition of a node is a number that means yes or no") {
  struct ConditionRow {
    std::string script;
    std::string result;
  };
  const std::string wrong =
      "a condition is true, false, 0, 1 or a number that is not negative and not whole, not ";
  const ConditionRow rows[] = {
      {"1", "yes"},
      {"0", "no"},
      {"0.5", "yes"},
      {"0/0", "yes"},
      {"1+1", "yes"},
      {"flag", "yes"},
      {"whole>1", "yes"},
      {"x:=1", "yes"},
      {"2", wrong + "2"},
      {"-0.5", wrong + "-0.5"},
      {"'true'", "yes"},
      {"true_text", "yes"},
      {"'False'", "no"},
      {"'0'", "no"},
      {"'2'", wrong + "the text '2'"},
      {"text", wrong + "the text 'abc'"},
      {"empty", wrong + "the entry 'empty' without a value"},
      {"missing", "there is no entry 'missing'; 'missing := …' makes it"},
  };
  for (const ConditionRow& row : rows) {
    INFO(row.script);
    ScriptBoard board = board_of_values();
    const auto script = Expression::parse(row.script);
    REQUIRE(script.has_value());
    std::vector<Entry*> entries;
    for (const std::string& name : script->names()) entries.push_back(&board.at(name));
    Evaluator evaluator;
    const Truth answer = evaluator.test(*script, entries);
    const std::string shown = answer == Truth::Yes ? "yes" : "no";
    CHECK((answer == Truth::Error ? evaluator.error() : shown) == row.result);
  }
}

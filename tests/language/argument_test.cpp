// docs/nodes-and-attributes.md: "Load-time arguments".
#include <catch2/catch.hpp>

#include "language/pipeline.h"

namespace lockstep::host::test {
namespace {

// A document with an argument 'a' (default 1), an argument 'b' (no default), and this tree.
std::string with_arguments(std::string_view tree) {
  return "<root lockstep=\"1\"><arg name=\"a\" default=\"1\"/><arg name=\"b\"/>"
         "<BehaviorTree ID=\"T\">\n" +
         std::string(tree) + "</BehaviorTree></root>";
}

TEST_CASE("arguments stand in any attribute, as a part of its value") {
  struct Row {
    std::string_view claim, tree, options, expected;
  };
  constexpr Row kRows[] = {
      {"the default", R"(<Say text="${a}"/>)", "arg.b=2", "success 1: 1"},
      {"--arg goes first", R"(<Say text="${a}"/>)", "arg.b=2 arg.a=3", "success 1: 3"},
      {"parts of a value", R"(<Say text="<${a}-${b}>"/>)", "arg.b=2",
       "2:12 error: '<' in the value of 'text'"},
      {"several in a value", R"(<Say text="${a}-${b}."/>)", "arg.b=2", "success 1: 1-2."},
      {"in parameters of built-in nodes", R"(<Repeat times="${b}"><Say text="x"/></Repeat>)",
       "arg.b=2", "success 2: x, x"},
      {"in names", R"(<Say name="n${b}" text="x"/>)", "arg.b=/",
       "2:12 error: the name 'n/' contains '/'"},
      {"a value may be a key", R"(<Say text="{${b}}"/>)", "arg.b=door set.door=red",
       "success 1: red"},
      {"$${ is a literal ${", R"(<Say text="$${a} costs $5"/>)", "arg.b=2",
       "success 1: ${a} costs $5"},
      {"a value is not looked into again", R"(<Say text="${b}"/>)", "arg.b=${a}",
       "success 1: ${a}"},
      {"no expressions", R"(<Say text="${a+1}"/>)", "arg.b=2",
       "2:12 error: unknown argument 'a+1'"},
      {"an argument without a default must be given", R"(<Wait seconds="${b}"/>)", "",
       "1:47 error: argument 'b' has no default and is not given"},
      {"an unknown one", R"(<Wait seconds="${c}"/>)", "arg.b=2",
       "2:16 error: unknown argument 'c'"},
      {"one that is not closed", R"(<Say text="${a"/>)", "arg.b=2",
       "2:12 error: '${' is not closed"},
      {"--arg names a declared one", R"(<AlwaysSuccess/>)", "arg.b=2 arg.c=1",
       "error: unknown argument 'c' in --arg"},
      {"the value is checked as if it were written", R"(<Wait seconds="${b}"/>)", "arg.b=-2",
       "2:16 error: -2 is outside the range of 'seconds'"},
      {"a literal ${ is no number", R"(<Wait seconds="$${b}"/>)", "arg.b=1",
       "2:16 error: '${b}' is not a number, which 'seconds' must be"},
  };
  for (const Row& row : kRows) {
    INFO(row.claim);
    CHECK(Pipeline(with_arguments(row.tree), row.options).run() == row.expected);
  }
}

TEST_CASE("declarations of arguments") {
  constexpr ClaimRow kRows[] = {
      {"a default may use what is declared before it",
       R"(<root lockstep="1"><arg name="a" default="x"/><arg name="b" default="${a}y" doc="both"/>
          <BehaviorTree ID="T"><Say text="${b}"/></BehaviorTree></root>)",
       "success 1: xy"},
      {"but not what comes after",
       R"(<root lockstep="1"><arg name="b" default="${a}"/><arg name="a" default="x"/>
          <BehaviorTree ID="T"><Say text="${a}"/></BehaviorTree></root>)",
       "1:43 error: unknown argument 'a'"},
      {"trees may stand before them",
       R"(<root lockstep="1"><BehaviorTree ID="T"><Say text="${a}"/></BehaviorTree>
          <arg name="a" default="x"/></root>)",
       "success 1: x"},
      {"names are identifiers",
       R"(<root lockstep="1"><arg name="2a" default="x"/>
          <BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree></root>)",
       "1:31 error: '2a' is not an identifier"},
      {"names are distinct",
       R"(<root lockstep="1"><arg name="a" default="x"/><arg name="a" default="y"/>
          <BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree></root>)",
       "1:58 error: argument 'a' is declared twice"},
      {"other attributes",
       R"(<root lockstep="1"><arg name="a" default="x" type="int"/>
          <BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree></root>)",
       "1:46 error: unknown attribute 'type' of 'arg'"},
  };
  check_runs(kRows);
}

}  // namespace
}  // namespace lockstep::host::test

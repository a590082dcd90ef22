// docs/nodes-and-attributes.md: "Entries" to "Scopes and remapping".
#include <catch2/catch.hpp>

#include "language/pipeline.h"

namespace lockstep::host::test {
namespace {

TEST_CASE("literals of each type") {
  constexpr ClaimRow kRows[] = {
      {"ports have defaults", R"(<Show/>)", "success 1: false 0 0 '' []"},
      {"bool, int, double, string, list",
       R"(<Show flag="true" count="-3" speed="+2.5e-1" text="a b" points="1;2"/>)",
       "success 1: true -3 0.25 'a b' [1;2;]"},
      {"bool is also 1 and 0", R"(<Show flag="1"/>)", "success 1: true 0 0 '' []"},
      {"bool is not a word of another kind", R"(<Show flag="yes"/>)",
       "2:13 error: 'yes' is not true or false, which 'flag' must be"},
      {"blanks around a value do not count, but in a string",
       R"(<Show flag=" true " count=" 4 " text=" x "/>)", "success 1: true 4 0 ' x ' []"},
      {"an int is whole", R"(<Show count="1.0"/>)",
       "2:14 error: '1.0' is not a whole number, which 'count' must be"},
      {"an int has 64 bits", R"(<Show count="9223372036854775808"/>)",
       "2:14 error: '9223372036854775808' is not a whole number, which 'count' must be"},
      {"a double is decimal", R"(<Show speed="0x10"/>)",
       "2:14 error: '0x10' is not a number, which 'speed' must be"},
      {"a double is finite", R"(<Show speed="inf"/>)",
       "2:14 error: 'inf' is not a number, which 'speed' must be"},
      {"a list is separated by ; or , or blanks", R"(<Show points="1;2, 3 4"/>)",
       "success 1: false 0 0 '' [1;2;3;4;]"},
      {"a list may be empty", R"(<Show points=""/>)", "success 1: false 0 0 '' []"},
      {"a number may not", R"(<Show count=""/>)",
       "2:14 error: '' is not a whole number, which 'count' must be"},
      {"braces that are not the whole value are text", R"(<Say text="a {b}"/>)",
       "success 1: a {b}"},
      {"empty braces too", R"(<Say text="{}"/>)", "success 1: {}"},
      {"XML writes special characters", R"(<Say text="&lt;&#33;&amp;&quot;"/>)",
       "success 1: <!&\""},
  };
  check_runs(kRows);
}

TEST_CASE("lists of each type") {
  constexpr ClaimRow kRows[] = {
      {"they have defaults", R"(<ShowLists/>)", "success 1: 1,2,true,false,'red','blue',"},
      {"numbers and bools are separated by ; or , or blanks",
       R"(<ShowLists steps="3, -4 5" flags="1;0 true"/>)",
       "success 1: 3,-4,5,true,false,true,'red','blue',"},
      {"strings by ; only, and blanks around them do not count",
       R"(<root lockstep="1" main_tree_to_execute="T">
          <BehaviorTree ID="T"><SubTree ID="S" d=" front door ; back, left"/></BehaviorTree>
          <BehaviorTree ID="S"><ShowLists steps="" flags="" doors="{d}"/></BehaviorTree></root>)",
       "success 1: 'front door','back, left',"},
      {"a backslash keeps the character after it",
       R"(<root lockstep="1" main_tree_to_execute="T">
          <BehaviorTree ID="T"><SubTree ID="S" d="a\;b;\\;\ "/></BehaviorTree>
          <BehaviorTree ID="S"><ShowLists steps="" flags="" doors="{d}"/></BehaviorTree></root>)",
       R"(success 1: 'a;b','\',' ',)"},
      {"a list has items of its type", R"(<ShowLists steps="1;0.5"/>)",
       "2:19 error: '1;0.5' is not a list such as 1;2, which 'steps' must be"},
      {"a bool too", R"(<ShowLists flags="1;2"/>)",
       "2:19 error: '1;2' is not a list such as true;false, which 'flags' must be"},
      {"they are written and read",
       R"(<Sequence memory="true"><ShowLists steps="1" flags="1" doors="{d}" next="{n}"
          inverse="{i}"/><ShowLists steps="{n}" flags="{i}" doors="{d}"/></Sequence>)",
       "success 1: 1,true,'x',, 2,false,'x','a;b',", "set.d=x"},
      {"lists of two types are two types",
       R"(<Sequence memory="true"><ShowLists steps="{x}"/>
<ShowLists flags="{x}"/></Sequence>)",
       "3:19 error: '{x}' is a list of bool for 'flags', but a list of int elsewhere", "set.x=1"},
  };
  for (const ClaimRow& row : kRows) {
    INFO(row.claim);
    const Pipeline pipeline(row.xml, row.options);
    CHECK((pipeline.loaded() ? pipeline.run() : pipeline.told()) == row.expected);
  }
}

TEST_CASE("ports that take some values only") {
  constexpr ClaimRow kRows[] = {
      {"what they take",
       R"(<Hold grip="firm" force="20" fingers="1" hand="right" angles="1;1.5"/>)",
       "success 1: firm 20 1 right 2"},
      {"a constant is checked when the tree is loaded", R"(<Hold force="21"/>)",
       "2:14 error: 21 is outside the range of 'force'"},
      {"one end may be open", R"(<Hold fingers="0"/>)",
       "2:16 error: 0 is outside the range of 'fingers'"},
      {"each number of a list is checked", R"(<Hold angles="1;2"/>)",
       "2:15 error: 2 is outside the range of 'angles'"},
      {"a word is one of the choices", R"(<Hold grip="hard"/>)",
       "2:13 error: 'hard' is not a value of 'grip'"},
      {"of a text too", R"(<Hold hand="both"/>)", "2:13 error: 'both' is not a value of 'hand'"},
      {"an entry is checked when it is read", R"(<Hold force="{f}"/>)",
       "success 1: soft 7 2 left 0", "set.f=7"},
      {"another value is a fault", R"(<Hold force="{f}"/>)",
       "fault: -1 is outside the range of 'force': 'force' is '-1', from the entry '{f}'; it must "
       "be from 0 to 20",
       "set.f=-1"},
      {"for a word too", R"(<Hold grip="{g}"/>)",
       "fault: 'hard' is not a value of 'grip': 'grip' is 'hard', from the entry '{g}'; it must be "
       "one of 'soft', 'firm'",
       "set.g=hard"},
      {"a leaf that changes the entry is checked by who reads it",
       R"(<Sequence memory="true"><FindDoor sees="hard" door="{g}"/><Hold grip="{g}"/></Sequence>)",
       "fault: 'hard' is not a value of 'grip': 'grip' is 'hard', from the entry '{g}'; it must be "
       "one of 'soft', 'firm'"},
      {"what a leaf writes is checked too", R"(<Hold force="20" angles="1;1;1" reached="{r}"/>)",
       "fault: cannot set 'reached': 23 is outside the range of 'reached'; it must be at most 22"},
      {"an output of words is a text for others",
       R"(<Sequence memory="true"><Hold grip="firm" used="{u}"/><Say text="{u}"/></Sequence>)",
       "success 1: firm 5 2 left 0, firm"},
  };
  for (const ClaimRow& row : kRows) {
    INFO(row.claim);
    const Pipeline pipeline(row.xml, row.options);
    CHECK((pipeline.loaded() ? pipeline.run() : pipeline.told()) == row.expected);
  }
}

TEST_CASE("a port that takes an int or a double") {
  constexpr ClaimRow kRows[] = {
      {"a whole constant is an int", R"(<Measure value="-3"/>)", "success 1: int -3"},
      {"another one is a double", R"(<Measure value="3.5"/>)", "success 1: double 3.5"},
      {"a text is neither", R"(<Measure value="fast"/>)",
       "2:17 error: 'fast' is not a number, which 'value' must be"},
      {"an entry may be an int",
       R"(<Sequence memory="true"><Count total="{n}"/><Measure value="{n}"/></Sequence>)",
       "success 1: 5, int 5", "set.n=4"},
      {"also if the number is its first use",
       R"(<Sequence memory="true"><Measure value="{n}"/><Count total="{n}"/></Sequence>)",
       "success 1: int 4, 5", "set.n=4"},
      {"or a double",
       R"(<Sequence memory="true"><Measure value="{v}"/><Show speed="{v}"/></Sequence>)",
       "success 1: double 2, false 0 2 '' []", "set.v=2"},
      {"an entry of numbers only has what it was given", R"(<Measure value="{v}"/>)",
       "success 1: int 2", "set.v=2"},
      {"a start value must fit all uses",
       "<Sequence memory=\"true\">\n<Measure value=\"{n}\"/>\n<Count total=\"{n}\"/></Sequence>",
       "4:15 error: the start value '0.5' of 'n' is not a whole number, which 'total' must be",
       "set.n=0.5"},
      {"int and double stay two types",
       "<Sequence memory=\"true\">\n<Measure value=\"{n}\"/><Count total=\"{n}\"/>\n"
       "<Show speed=\"{n}\"/></Sequence>",
       "4:14 error: '{n}' is a double for 'speed', but an int elsewhere", "set.n=1"},
      {"a text is no number",
       "<Sequence memory=\"true\">\n<Say text=\"{n}\"/>\n<Measure value=\"{n}\"/></Sequence>",
       "4:17 error: '{n}' is an int or double for 'value', but a string elsewhere", "set.n=1"},
      {"the default counts until the entry is written",
       R"(<Sequence memory="true"><Measure value="{n}"/><Tally sum="{n}"/><Measure value="{n}"/>
          </Sequence>)",
       "success 1: int 1, 11, int 11"},
  };
  for (const ClaimRow& row : kRows) {
    INFO(row.claim);
    const Pipeline pipeline(row.xml, row.options);
    CHECK((pipeline.loaded() ? pipeline.run() : pipeline.told()) == row.expected);
  }
}

TEST_CASE("ports: given, left out, bound") {
  constexpr ClaimRow kRows[] = {
      {"an input without a default must be given", R"(<GoTo/>)",
       "2:1 error: 'GoTo' needs the parameter 'target'"},
      {"an inout too", R"(<Count/>)", "2:1 error: 'Count' needs the parameter 'total'"},
      {"an output may be left out", R"(<FindDoor/>)", ""},
      {"an output needs a key", R"(<FindDoor door="x"/>)",
       "2:17 error: the output 'door' needs a blackboard entry"},
      {"an inout needs a key", R"(<Count total="3"/>)",
       "2:15 error: the inout 'total' needs a blackboard entry"},
      {"an attribute that is no port", R"(<Say txt="a"/>)",
       "2:6 error: 'Say' has no parameter 'txt'"},
      {"a required parameter that is misspelled is one error",
       R"(<Timeout msec="3"><Wait secons="1"/></Timeout>)",
       "2:10 error: 'Timeout' has no parameter 'msec'\n2:25 error: 'Wait' has no parameter "
       "'secons'"},
      {"a key is an identifier", R"(<Say text="{the door}"/>)",
       "2:12 error: 'the door' is not a key"},
      {"a parameter of a built-in node may be a key", R"(<Wait seconds="{pause}"/>)",
       "2:16 warning: nothing writes '{pause}'"},
      {"a list too", R"(<ParallelAbsolute barriers="{plan}"><AlwaysSuccess/></ParallelAbsolute>)",
       "2:29 warning: nothing writes '{plan}'"},
      {"what shapes the tree may not", R"(<Sequence memory="{m}"><AlwaysSuccess/></Sequence>)",
       "2:19 error: 'memory' of 'Sequence' cannot be a blackboard entry"},
  };
  check_told(kRows);
}

TEST_CASE("entries: written, read, set, typed") {
  constexpr ClaimRow kRows[] = {
      {"what one leaf writes another reads",
       R"(<Sequence memory="true"><FindDoor sees="red" door="{door}"/><GoTo target="{door}"/>
          </Sequence>)",
       "success 2: go to red"},
      {"--set gives a start value", R"(<GoTo target="{door}"/>)", "success 2: go to blue",
       "set.door=blue"},
      {"the value has the type of the ports", R"(<Show speed="{v}"/>)",
       "2:14 error: the start value 'fast' of 'v' is not a number, which 'speed' must be",
       "set.v=fast"},
      {"--set names an entry of the main tree", R"(<GoTo target="{door}"/>)",
       "error: --set dor: the main tree does not use '{dor}'", "set.dor=blue"},
      {"an entry has one type",
       "<Sequence memory=\"true\">\n<GoTo target=\"{x}\"/>\n<Show speed=\"{x}\"/></Sequence>",
       "4:14 error: '{x}' is a double for 'speed', but a string elsewhere", "set.x=1"},
      {"int and double are two types",
       "<Sequence>\n<Count total=\"{x}\"/>\n<Show speed=\"{x}\"/></Sequence>",
       "4:14 error: '{x}' is a double for 'speed', but an int elsewhere"},
      {"an entry that nobody wrote has no value", R"(<GoTo target="{door}"/>)",
       "fault: port 'target' has no value: nothing has written the entry '{door}'"},
      {"it is named with the path of its SubTree",
       "<root lockstep=\"1\" main_tree_to_execute=\"T\"><BehaviorTree ID=\"T\"><SubTree ID=\"S\"/>"
       "</BehaviorTree><BehaviorTree ID=\"S\"><GoTo target=\"{door}\"/></BehaviorTree></root>",
       "fault: port 'target' has no value: nothing has written the entry '{S/door}'"},
      {"a port with a default has that until somebody writes the entry",
       R"(<Sequence memory="true"><FindDoor sees="{s}" door="{door}"/><Say text="{door}"/>
          <FindDoor sees="{door}" door="{s}"/><FindDoor sees="{s}" door="{t}"/><Say text="{t}"/>
          </Sequence>)",
       "success 1: front door, front door"},
      {"the default is that of the port, not of the entry",
       R"(<Sequence memory="true"><FindDoor sees="{s}" door="{door}"/><Say text="{s}"/></Sequence>)",
       "fault: port 'text' has no value: nothing has written the entry '{s}'"},
      {"the default of an inout counts until it is written",
       R"(<Repeat times="3"><Tally sum="{n}"/></Repeat>)", "success 3: 11, 12, 13"},
      {"an inout that is left out has its default each time",
       R"(<Repeat times="2"><Tally/></Repeat>)", "success 2: 10, 10"},
      {"an inout reads and writes", R"(<Repeat times="3"><Count total="{n}"/></Repeat>)",
       "success 3: 5, 6, 7", "set.n=4"},
  };
  for (const ClaimRow& row : kRows) {
    INFO(row.claim);
    const Pipeline pipeline(row.xml, row.options);
    CHECK((pipeline.loaded() ? pipeline.run() : pipeline.told()) == row.expected);
  }
}

// `attributes` of a SubTree 'Inner' between leaves that write and read {door} outside of it.
std::string with_inner(std::string_view attributes) {
  return R"(<root lockstep="1" main_tree_to_execute="Outer"><BehaviorTree ID="Outer">
            <Sequence memory="true"><FindDoor sees="red" door="{door}"/><SubTree ID="Inner" )" +
         std::string(attributes) + R"(/><Say text="{door}"/></Sequence></BehaviorTree>
            <BehaviorTree ID="Inner"><Sequence memory="true"><Say text="{door}"/>
            <FindDoor sees="green" door="{door}"/></Sequence></BehaviorTree></root>)";
}

TEST_CASE("each SubTree has a scope of its own") {
  struct Row {
    std::string_view claim, attributes, expected;
  };
  constexpr Row kRows[] = {
      {"a key inside is another entry than outside", R"(door="blue")", "success 1: blue, red"},
      {"remapped it is the same entry, both ways", R"(door="{door}")", "success 1: red, green"},
      {"_autoremap passes on every key", R"(_autoremap="true")", "success 1: red, green"},
      {"an attribute goes before _autoremap", R"(_autoremap="true" door="blue")",
       "success 1: blue, red"},
      {"_autoremap is true or false", R"(_autoremap="1" name="x")", "success 1: red, green"},
  };
  for (const Row& row : kRows) {
    INFO(row.claim);
    CHECK(Pipeline(with_inner(row.attributes)).run() == row.expected);
  }
}

TEST_CASE("no two entries have the same key") {
  const Pipeline pipeline(
      R"(<root lockstep="1" main_tree_to_execute="T"><BehaviorTree ID="T"><Parallel>
<Sequence><SubTree ID="G" name="grasp"/></Sequence><Sequence><SubTree ID="G" name="grasp"/></Sequence>
<SubTree ID="H" name="grasp"/><Script code="a := 1"/></Parallel></BehaviorTree>
<BehaviorTree ID="G"><Sequence><Script code="x := 1"/><Script code="y := 2"/></Sequence></BehaviorTree>
<BehaviorTree ID="H"><Sequence><Script code="z := 3"/><Script code="x := 7"/><Script code="y := 7"/>
</Sequence></BehaviorTree></root>)");
  INFO(pipeline.told());
  REQUIRE(pipeline.loaded());
  std::string keys;
  for (const Slot& slot : pipeline.tree().slots) keys += slot.name + ' ';
  CHECK(keys == "grasp/x grasp/y grasp#2/x grasp#2/y grasp/z grasp#3/x grasp#3/y a ");
}

TEST_CASE("remapping: names differ, levels add up, each use is a scope") {
  constexpr ClaimRow kRows[] = {
      {"inner key = outer key",
       R"(<root lockstep="1" main_tree_to_execute="M"><BehaviorTree ID="M"><Sequence memory="true">
          <FindDoor sees="red" door="{the_door}"/><SubTree ID="S" text="{the_door}"/></Sequence>
          </BehaviorTree><BehaviorTree ID="S"><Say text="{text}"/></BehaviorTree></root>)",
       "success 1: red"},
      {"through two levels",
       R"(<root lockstep="1" main_tree_to_execute="M"><BehaviorTree ID="M">
          <SubTree ID="A" x="{n}"/></BehaviorTree>
          <BehaviorTree ID="A"><SubTree ID="B" y="{x}"/></BehaviorTree>
          <BehaviorTree ID="B"><Count total="{y}"/></BehaviorTree></root>)",
       "success 1: 8", "set.n=7"},
      {"two uses of a tree share nothing",
       R"(<root lockstep="1" main_tree_to_execute="M"><BehaviorTree ID="M"><Sequence>
          <SubTree ID="A" n="1"/><SubTree ID="A" n="5"/></Sequence></BehaviorTree>
          <BehaviorTree ID="A"><Count total="{n}"/></BehaviorTree></root>)",
       "success 1: 2, 6"},
      {"but what both remap to",
       R"(<root lockstep="1" main_tree_to_execute="M"><BehaviorTree ID="M"><Sequence>
          <SubTree ID="A" n="{m}"/><SubTree ID="A" n="{m}"/></Sequence></BehaviorTree>
          <BehaviorTree ID="A"><Count total="{n}"/></BehaviorTree></root>)",
       "success 1: 1, 2"},
      {"an entry lives as long as the run: a second activation finds what the first wrote",
       R"(<root lockstep="1" main_tree_to_execute="M"><BehaviorTree ID="M"><Repeat times="2">
          <SubTree ID="A" n="1"/></Repeat></BehaviorTree>
          <BehaviorTree ID="A"><Count total="{n}"/></BehaviorTree></root>)",
       "success 2: 2, 3"},
  };
  check_runs(kRows);
}

TEST_CASE("what is wrong with a SubTree") {
  constexpr ClaimRow kRows[] = {
      {"it needs an ID", R"(<SubTree/>)", "2:1 error: 'SubTree' needs the attribute 'ID'"},
      {"the ID is a tree's", R"(<SubTree ID="Hold"/>)", "2:14 error: unknown tree 'Hold'"},
      {"it has no children", R"(<SubTree ID="T"><AlwaysSuccess/></SubTree>)",
       "2:14 error: the tree 'T' contains itself: T -> T\n"
       "2:17 error: 'SubTree' cannot have children"},
      {"its keys are identifiers", R"(<SubTree ID="T" the.door="x" door="{the.door}"/>)",
       "2:14 error: the tree 'T' contains itself: T -> T\n"
       "2:17 error: 'the.door' is not a key\n2:36 error: 'the.door' is not a key"},
      {"attributes that begin with '_' are the language's own", R"(<SubTree ID="T" _skipIf="x"/>)",
       "2:14 error: the tree 'T' contains itself: T -> T\n"
       "2:17 error: 'SubTree' has no attribute '_skipIf'"},
      {"_autoremap is a bool", R"(<SubTree ID="T" _autoremap="yes"/>)",
       "2:14 error: the tree 'T' contains itself: T -> T\n2:29 error: 'yes' is not true or false"},
      {"recursion shows the chain",
       "<root lockstep=\"1\" main_tree_to_execute=\"A\">\n"
       "<BehaviorTree ID=\"A\"><SubTree ID=\"B\"/></BehaviorTree>\n"
       "<BehaviorTree ID=\"B\"><SubTree ID=\"A\"/></BehaviorTree></root>",
       "3:35 error: the tree 'A' contains itself: A -> B -> A"},
      {"a start value is checked against the port that uses it",
       "<root lockstep=\"1\" main_tree_to_execute=\"A\">\n"
       "<BehaviorTree ID=\"A\"><SubTree ID=\"B\" n=\"many\"/></BehaviorTree>\n"
       "<BehaviorTree ID=\"B\"><Count total=\"{n}\"/></BehaviorTree></root>",
       "3:36 error: the start value 'many' of 'B/n' is not a whole number, which 'total' must be"},
      {"types are compared through a remapping",
       "<root lockstep=\"1\" main_tree_to_execute=\"A\">\n"
       "<BehaviorTree ID=\"A\"><Sequence><FindDoor door=\"{d}\"/><SubTree ID=\"B\" n=\"{d}\"/>"
       "</Sequence></BehaviorTree>\n"
       "<BehaviorTree ID=\"B\"><Count total=\"{n}\"/></BehaviorTree></root>",
       "3:36 error: '{n}' is an int for 'total', but a string elsewhere"},
      {"an attribute that the tree does not use is doubtful",
       "<root lockstep=\"1\" main_tree_to_execute=\"A\">\n"
       "<BehaviorTree ID=\"A\"><SubTree ID=\"B\" n=\"1\"/></BehaviorTree>\n"
       "<BehaviorTree ID=\"B\"><AlwaysSuccess/></BehaviorTree></root>",
       "2:38 warning: the tree 'B' does not use '{n}'"},
  };
  check_told(kRows);
}

}  // namespace
}  // namespace lockstep::host::test

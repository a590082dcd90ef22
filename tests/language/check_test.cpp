// docs/nodes-and-attributes.md: "What check reports" and "Limits".
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "language/pipeline.h"
#include "tree/definition.h"
#include "unit/document/temporary_directory.h"

namespace lockstep::host::test {
namespace {

TEST_CASE("all errors are reported in one pass, sorted by their places") {
  constexpr ClaimRow kRows[] = {
      {"of the document, its nodes, its arguments, its subtrees",
       R"(<root lockstep="1" main_tree_to_execute="Main" color="red">
  <arg name="a" default="${b}"/>
  <include/>
  <BehaviorTree ID="Main">
    <Sequence>
      <Sequnce/>
      <Repeat times="0"><AlwaysSuccess/><AlwaysSuccess/></Repeat>
      <SubTree ID="Grasp"/>
      <ParallelRelative delta="2"><Say/></ParallelRelative>
      hello
    </Sequence>
  </BehaviorTree>
  <BehaviorTree ID="Loop"><SubTree ID="Loop"/></BehaviorTree>
</root>)",
       "1:48 error: 'root' has no attribute 'color'\n"
       "2:26 error: unknown argument 'b'\n"
       "3:3 error: 'include' needs the attribute 'path'\n"
       "6:7 error: unknown node 'Sequnce'\n"
       "7:22 error: 0 is outside the range of 'times'\n"
       "7:41 error: 'Repeat' has more than one child\n"
       "8:20 error: unknown tree 'Grasp'\n"
       "9:32 error: 2 is outside the range of 'delta'\n"
       "9:35 error: 'Say' needs the parameter 'text'\n"
       "10:7 error: text is not part of the language\n"
       "13:40 error: the tree 'Loop' contains itself: Loop -> Loop"},
      {"an XML error ends the file at once",
       "<root lockstep=\"1\">\n<BehaviorTree ID=\"T\"><Sequnce></BehaviorTree></root>",
       "2:31 error: '</BehaviorTree>' closes '<Sequnce>', opened at line 2"},
  };
  check_told(kRows);
}

TEST_CASE("hints") {
  struct Row {
    std::string_view xml, hint;
  };
  constexpr Row kRows[] = {
      {R"(<Sequnce/>)", "did you mean 'Sequence'?"},
      {R"(<Wait second="1"/>)", "parameters of 'Wait': 'seconds'"},
      {R"(<Inverter/>)", "it is a decorator: put a node into it"},
      {R"(<IfThenElse><AlwaysSuccess/></IfThenElse>)",
       "it has 1; `lockstep nodes IfThenElse` describes them"},
      {R"(<Timeout seconds="0"><AlwaysSuccess/></Timeout>)", "it must be more than 0, at most"},
      {R"(<ParallelAbsolute barriers="0.5;0.2"><AlwaysSuccess/></ParallelAbsolute>)",
       "write '0.2;0.5'"},
      {R"(<SubTree ID="Q"/>)", "trees in this project: 'T'"},
  };
  for (const Row& row : kRows) {
    INFO(row.xml);
    const Pipeline pipeline(row.xml);
    REQUIRE_FALSE(pipeline.diagnostics().all().empty());
    CHECK(pipeline.diagnostics().all().front().hint.find(row.hint) != std::string::npos);
  }
}

TEST_CASE("each node is checked for its own attributes, whatever others of its type have") {
  constexpr ClaimRow kRows[] = {
      {"one type, other attributes, another order", R"(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Sequence memory="true">
      <Wait seconds="1"/>
      <Wait name="a" seconds="-1"/>
      <Wait seconds="-2" name="a"/>
      <Wait secnds="1" name="c/d"/>
      <Wait secnds="1" name="c/d"/>
      <Wait name="d"/>
      <Wait/>
      <Action ID="Wait" seconds="-1"/>
      <Wait ID="Wait" seconds="1"/>
      <Wait seconds="1" skip_if="1 +"/>
      <Wait seconds="1" skip_if="2 +"/>
      <AlwaysSuccess seconds="1"/>
      <Wait seconds="-1"/>
    </Sequence>
  </BehaviorTree>
</root>)",
       "5:31 error: -1 is outside the range of 'seconds'\n"
       "6:22 error: -2 is outside the range of 'seconds'\n"
       "7:13 error: 'Wait' has no parameter 'secnds'\n"
       "7:30 error: the name 'c/d' contains '/'\n"
       "8:13 error: 'Wait' has no parameter 'secnds'\n"
       "8:30 error: the name 'c/d' contains '/'\n"
       "9:7 error: 'Wait' needs the parameter 'seconds'\n"
       "10:7 error: 'Wait' needs the parameter 'seconds'\n"
       "11:34 error: -1 is outside the range of 'seconds'\n"
       "12:13 error: 'Wait' has no parameter 'ID'\n"
       "13:37 error: a value is missing at the end\n"
       "14:37 error: a value is missing at the end\n"
       "15:22 error: 'AlwaysSuccess' has no parameter 'seconds'\n"
       "16:22 error: -1 is outside the range of 'seconds'"},
  };
  check_told(kRows);
}

TEST_CASE("leaves share the defaults of ports that they leave out, and equal constants") {
  const auto constants = [](std::string_view leaves) {
    const Pipeline pipeline(fmt::format("<Parallel>{}</Parallel>", leaves));
    REQUIRE(pipeline.loaded());
    return pipeline.tree().constants.size();
  };
  const std::size_t one = constants(R"(<Advance step="0.5"/>)");
  CHECK(one > 2);
  CHECK(constants(R"(<Advance step="0.5"/><Advance step="0.25"/>)") == one + 1);
  CHECK(constants(R"(<Advance step="0.5"/><Advance/><Advance name="b" step="0.5"/>)") == one + 1);
}

TEST_CASE("nodes of other libraries: what to write instead") {
  struct Row {
    std::string_view xml, hint;
  };
  constexpr Row kRows[] = {
      {R"(<RetryUntilSuccessful num_attempts="5"><AlwaysSuccess/></RetryUntilSuccessful>)",
       "write <Retry attempts=\"5\">; one attempt in each tick; without a limit: a <Repeat> "
       "between two "
       "<Inverter>"},
      {R"(<RetryUntilSuccessful name="r" num_attempts="-1"><AlwaysSuccess/></RetryUntilSuccessful>)",
       "write <Retry attempts=\"…\">; one attempt in each tick; without a limit: a <Repeat> "
       "between two "
       "<Inverter>"},
      {R"(<Sleep msec="1500"/>)", "write <Wait seconds=\"1.5\">"},
      {R"(<Sleep msec="{pause}"/>)", "write <Wait seconds=\"…\">"},
      {R"(<Action ID="Sleep" msec="20"/>)", "write <Wait seconds=\"0.02\">"},
      {R"(<ReactiveSequence><AlwaysSuccess/></ReactiveSequence>)", "write <Sequence>"},
      {R"(<FallbackStar><AlwaysSuccess/></FallbackStar>)", "write <Fallback memory=\"true\">"},
      {R"(<ScriptCondition code="a &lt; 1"/>)", "write <Check code=\"a &lt; 1\">"},
      {R"(<Switch2 variable="{mode}" case_1="a" case_2="b"><AlwaysSuccess/></Switch2>)",
       "write <Switch on=\"mode\">; its cases are one list: cases=\"dock;drive\""},
      {R"(<BlackboardCheckInt value_A="{a}"/>)", "write <Check code=\"key == 'value'\"/>"},
      {R"(<SubTreePlus ID="T" __autoremap="true"/>)",
       "write <SubTree ID=\"T\" _autoremap=\"true\">"},
      {R"(<RecoveryNode number_of_retries="6"><AlwaysSuccess/><AlwaysSuccess/></RecoveryNode>)",
       "the plugin nav has it: add <plugin name=\"nav\"/>"},
      {R"(<Repeat num_cycles="3"><AlwaysSuccess/></Repeat>)",
       "write times=\"3\"; one iteration in each tick"},
      {R"(<Repeat num_cycles="-1"><AlwaysSuccess/></Repeat>)",
       "leave it out; one iteration in each tick"},
      {R"(<Timeout seconds="1" msec="200"><AlwaysSuccess/></Timeout>)", "write seconds=\"0.2\""},
      {R"(<Delay seconds="1" delay_msec="5"><AlwaysSuccess/></Delay>)", "write seconds=\"0.005\""},
      {R"(<Parallel success_threshold="2"><AlwaysSuccess/><AlwaysSuccess/></Parallel>)",
       "write success_count=\"2\"; counts are 1 or more"},
      {R"(<AlwaysSuccess _skipIf="x &amp;&amp; y"/>)", "write skip_if=\"x &amp;&amp; y\""},
      {R"(<SubTree ID="T" _onHalted="x := 1"/>)", "write on_halt=\"x := 1\""},
      {R"(<GoTo target="x" _uid="3"/>)", "leave it out; a mark of an editor"},
      {"<root lockstep=\"1\"><TreeNodeModel/><BehaviorTree "
       "ID=\"T\"><AlwaysSuccess/></BehaviorTree>"
       "</root>",
       "delete it: ports come from the plugin, and `lockstep nodes` lists them"},
  };
  for (const Row& row : kRows) {
    INFO(row.xml);
    const Pipeline pipeline(row.xml);
    REQUIRE_FALSE(pipeline.diagnostics().all().empty());
    CHECK(pipeline.diagnostics().all().front().hint == row.hint);
  }
}

TEST_CASE("keys: what was probably meant") {
  struct Row {
    std::string_view xml, hint;
  };
  constexpr Row kRows[] = {
      {R"(<Sequence memory="true"><FindDoor door="{door}"/><GoTo target="{dorr}"/></Sequence>)",
       "did you mean 'door'?"},
      {R"(<Sequence memory="true"><FindDoor door="{door}"/><GoTo target="{window}"/></Sequence>)",
       "give it a value with --set window=…"},
      {R"(<GoTo target="x" speed="{sped}"/>)",
       "it stays '0.5', the default of 'speed'; give it a value with --set sped=…"},
      {"<root lockstep=\"1\" main_tree_to_execute=\"T\"><BehaviorTree ID=\"T\"><Sequence "
       "memory=\"true\"><FindDoor door=\"{place}\"/><SubTree ID=\"S\"/></Sequence></BehaviorTree>"
       "<BehaviorTree ID=\"S\"><GoTo target=\"{plac}\"/></BehaviorTree></root>",
       "give it a value by an attribute of the SubTree"},
      {"<root lockstep=\"1\" main_tree_to_execute=\"T\"><BehaviorTree ID=\"T\"><SubTree ID=\"S\" "
       "place=\"a\" placee=\"b\" greting=\"c\"/></BehaviorTree><BehaviorTree ID=\"S\"><Sequence "
       "memory=\"true\"><GoTo target=\"{place}\"/><Say "
       "text=\"{greeting}\"/></Sequence></BehaviorTree>"
       "</root>",
       "it also uses: 'greeting'"},
      {"<root lockstep=\"1\" main_tree_to_execute=\"T\"><BehaviorTree ID=\"T\"><SubTree ID=\"S\" "
       "greting=\"c\"/></BehaviorTree><BehaviorTree ID=\"S\"><Say "
       "text=\"{greeting}\"/></BehaviorTree>"
       "</root>",
       "did you mean 'greeting'?"},
      {"<root lockstep=\"1\" main_tree_to_execute=\"T\"><BehaviorTree ID=\"T\"><SubTree ID=\"S\" "
       "greting=\"c\"/></BehaviorTree><BehaviorTree "
       "ID=\"S\"><AlwaysSuccess/></BehaviorTree></root>",
       ""},
  };
  for (const Row& row : kRows) {
    INFO(row.xml);
    const Pipeline pipeline(row.xml);
    REQUIRE_FALSE(pipeline.diagnostics().all().empty());
    CHECK(pipeline.diagnostics().all().front().severity == Severity::Warning);
    CHECK(pipeline.diagnostics().all().front().hint == row.hint);
  }
}

TEST_CASE("parameters of the parallel nodes") {
  constexpr ClaimRow kRows[] = {
      {"barriers or barrier_count", R"(<ParallelAbsolute><AlwaysSuccess/></ParallelAbsolute>)",
       "2:1 error: 'barriers' or 'barrier_count' is missing"},
      {"not both",
       R"(<ParallelAbsolute barriers="1" barrier_count="1"><AlwaysSuccess/></ParallelAbsolute>)",
       "2:47 error: both 'barriers' and 'barrier_count' are given"},
      {"barriers rise",
       R"(<ParallelAbsolute barriers="0.5;0.2"><AlwaysSuccess/></ParallelAbsolute>)",
       "2:29 error: barriers must rise"},
      {"no barrier twice",
       R"(<ParallelAbsolute barriers="0.5;0.5"><AlwaysSuccess/></ParallelAbsolute>)",
       "2:29 error: barrier 0.5 is given twice"},
      {"no barrier below 0",
       R"(<ParallelAbsolute barriers="-1"><AlwaysSuccess/></ParallelAbsolute>)",
       "2:29 error: -1 is outside the range of 'barriers'"},
      {"a barrier at 1, and none at all, are legal",
       R"(<Parallel><ParallelAbsolute barriers="1"><AlwaysSuccess/></ParallelAbsolute>
          <ParallelAbsolute barriers=""><AlwaysSuccess/></ParallelAbsolute>
          <ParallelAbsolute barrier_count="0"><AlwaysSuccess/></ParallelAbsolute></Parallel>)",
       ""},
      {"at_barrier is a word",
       R"(<ParallelAbsolute barriers="1" at_barrier="go"><AlwaysSuccess/></ParallelAbsolute>)",
       "2:44 error: 'go' is not a value of 'at_barrier'"},
      {"delta is required", R"(<ParallelRelative><AlwaysSuccess/></ParallelRelative>)",
       "2:1 error: 'ParallelRelative' needs the parameter 'delta'"},
      {"no more successes than children",
       R"(<Parallel success_count="2"><AlwaysSuccess/></Parallel>)",
       "2:26 error: 'success_count' is more than the 1 children of the node"},
      {"counts are not negative", R"(<Parallel failure_count="-1"><AlwaysSuccess/></Parallel>)",
       "2:26 error: -1 is outside the range of 'failure_count'"},
  };
  check_told(kRows);
}

TEST_CASE("warnings and notes") {
  constexpr ClaimRow kRows[] = {
      {"an action before an action, without memory",
       "<Sequence>\n<GoTo name=\"first\" target=\"a\"/>\n<GoTo name=\"second\" "
       "target=\"b\"/></Sequence>",
       "3:1 warning: 'first' is started again in every tick in which 'second' runs"},
      {"not with memory", R"(<Sequence memory="true"><GoTo target="a"/><GoTo target="b"/>
                             </Sequence>)",
       ""},
      {"not after conditions only", R"(<Sequence><IsOpen/><GoTo target="b"/></Sequence>)", ""},
      {"not where a condition asks first",
       R"(<Sequence><Fallback><IsOpen/><GoTo target="a"/></Fallback><GoTo target="b"/></Sequence>)",
       ""},
      {"not where conditions under decorators ask first",
       R"(<Sequence><Fallback><Inverter><IsOpen/></Inverter><GoTo target="a"/></Fallback>
          <GoTo target="b"/></Sequence>)",
       ""},
      {"not before what completes at once",
       R"(<Sequence><GoTo target="a"/><IsOpen/><AlwaysSuccess/></Sequence>)", ""},
      {"an action of a plugin, whatever its name",
       "<Sequence>\n<AlwaysReach target=\"a\"/>\n<GoTo target=\"b\"/></Sequence>",
       "3:1 warning: 'AlwaysReach' is started again in every tick in which 'GoTo' runs"},
      {"an action before what is asked first and may run",
       "<Sequence>\n<GoTo name=\"first\" target=\"a\"/>\n<Fallback><IsOpen/><GoTo target=\"b\"/>"
       "</Fallback></Sequence>",
       "3:1 warning: 'first' is started again in every tick in which 'Fallback' runs"},
      {"an action before a decorator that may run by itself",
       "<Sequence>\n<GoTo name=\"first\" target=\"a\"/>\n<Delay seconds=\"1\"><IsOpen/></Delay>"
       "</Sequence>",
       "3:1 warning: 'first' is started again in every tick in which 'Delay' runs"},
      {"an action before an action in a Fallback",
       "<Fallback>\n<GoTo name=\"first\" target=\"a\"/>\n<GoTo name=\"second\" target=\"b\"/>"
       "</Fallback>",
       "3:1 warning: 'first' is started again in every tick in which 'second' runs"},
      {"not in a Fallback with memory",
       R"(<Fallback memory="true"><GoTo target="a"/><GoTo target="b"/></Fallback>)", ""},
      {"not in a Fallback where a condition asks first",
       R"(<Fallback><Sequence><IsOpen/><GoTo target="a"/></Sequence><GoTo target="b"/></Fallback>)",
       ""},
      {"but where what was asked has failed all the same",
       "<Fallback>\n<Fallback name=\"first\"><IsOpen/><GoTo target=\"a\"/></Fallback>\n"
       "<GoTo name=\"second\" target=\"b\"/></Fallback>",
       "3:1 warning: 'first' is started again in every tick in which 'second' runs"},
      {"in a Fallback, through decorators",
       "<Fallback>\n<Inverter name=\"first\"><Timeout seconds=\"9\"><GoTo target=\"a\"/></Timeout>"
       "</Inverter>\n<Retry attempts=\"3\" name=\"second\"><GoTo target=\"b\"/></Retry></Fallback>",
       "3:1 warning: 'first' is started again in every tick in which 'second' runs"},
      {"an Inverter swaps what is asked first",
       R"(<Sequence><Inverter><Sequence><IsOpen/><GoTo target="a"/></Sequence></Inverter>
          <GoTo target="b"/></Sequence>)",
       ""},
      {"in a Fallback, through subtrees",
       "<root lockstep=\"1\" main_tree_to_execute=\"A\"><plugin name=\"robot\"/>\n"
       "<BehaviorTree ID=\"A\"><Fallback>\n<SubTree ID=\"B\"/>\n<SubTree ID=\"C\"/>\n</Fallback>"
       "</BehaviorTree>\n"
       "<BehaviorTree ID=\"B\"><GoTo target=\"a\"/></BehaviorTree>\n"
       "<BehaviorTree ID=\"C\"><GoTo target=\"b\"/></BehaviorTree></root>",
       "3:1 warning: 'B' is started again in every tick in which 'C' runs"},
      {"not for RunOnce",
       R"(<Sequence><RunOnce><GoTo target="a"/></RunOnce><GoTo target="b"/></Sequence>)", ""},
      {"an entry that nobody writes, once",
       "<Parallel>\n<Say text=\"{x}\"/><Say text=\"{x}\"/>"
       "</Parallel>",
       "3:12 warning: nothing writes '{x}'"},
      {"an entry inside a SubTree",
       "<root lockstep=\"1\" main_tree_to_execute=\"A\">\n"
       "<BehaviorTree ID=\"A\"><SubTree ID=\"B\"/></BehaviorTree>\n"
       "<BehaviorTree ID=\"B\"><Say text=\"{x}\"/></BehaviorTree></root>",
       "3:33 warning: nothing writes '{B/x}'"},
      {"an action without progress under a synchronized node",
       "<ParallelRelative delta=\"0.1\">\n<Inverter><Say text=\"x\"/></Inverter>\n"
       "<GoTo target=\"a\"/></ParallelRelative>",
       "3:11 note: 'Say' reports no progress: for 'ParallelRelative' it is at 0 until it "
       "succeeds"},
  };
  check_told(kRows);
}

std::string nested(int inverters) {
  std::string xml;
  for (int i = 0; i < inverters; ++i) xml += "<Inverter>";
  xml += "<AlwaysSuccess/>";
  for (int i = 0; i < inverters; ++i) xml += "</Inverter>";
  return xml;
}

// T1 uses T0 `width` times under one more node, T2 so uses T1, and so on.
std::string tower(int levels, int width, std::string_view ground = "<AlwaysSuccess/>") {
  std::string xml = fmt::format(
      "<root lockstep=\"1\" main_tree_to_execute=\"T{}\"><BehaviorTree ID=\"T0\">{}</BehaviorTree>",
      levels, ground);
  for (int level = 1; level <= levels; ++level) {
    xml += fmt::format("\n<BehaviorTree ID=\"T{}\"><Parallel>", level);
    for (int i = 0; i < width; ++i) xml += fmt::format("<SubTree ID=\"T{}\"/>", level - 1);
    xml += "</Parallel></BehaviorTree>";
  }
  return xml + "</root>";
}

TEST_CASE("a port of a plugin's node may have the name of a parameter of a built-in node") {
  constexpr ClaimRow kRows[] = {{"memory, of a control node",
                                 R"(<Sequence memory="true"><Script code="m := true"/>
       <Either memory="{m}"><Say text="first"/><Say text="second"/></Either></Sequence>)",
                                 "success 1: second"},
                                {"times, around a member that keeps its resources",
                                 R"(<root lockstep="1"><resources name="p"/><BehaviorTree ID="T">
       <ParallelAbsolute barriers="0.5">
         <At times="noon"><UseResources pool="p" resources="A" keep="true"><Wait seconds="0"/></UseResources></At>
         <UseResources pool="p" resources="A"><Wait seconds="0"/></UseResources>
       </ParallelAbsolute></BehaviorTree></root>)",
                                 "success 2: noon"}};
  check_runs(kRows);
}

TEST_CASE("limits are named, and nothing breaks at them") {
  CHECK(Pipeline(nested(999)).run() == "failure 1");  // with the leaf: 1000
  CHECK(Pipeline(nested(1000)).told() ==
        "2:1 error: the tree 'T' is 1001 nodes deep with its subtrees expanded");
  CHECK(Pipeline(nested(1022)).told() ==
        "2:10221 error: elements are nested deeper than 1024 levels");
  CHECK(Pipeline(tower(499, 1, "<Inverter><AlwaysFailure/></Inverter>")).run() ==
        "success 1");  // two nodes a level, and two: 1000
  CHECK(Pipeline(tower(500, 1)).told() ==
        "501:25 error: the tree 'T500' is 1001 nodes deep with its subtrees expanded");
  CHECK(Pipeline(tower(20, 2)).told() ==
        "21:24 error: the tree 'T20' has 4194301 nodes with its subtrees expanded");
  CHECK(Pipeline("<ParallelAbsolute barrier_count=\"100001\"><AlwaysSuccess/></ParallelAbsolute>")
            .told() == "2:34 error: 100001 is outside the range of 'barrier_count'");
  CHECK(Pipeline("<Wait seconds=\"1.1e9\"/>").told() ==
        "2:16 error: 1100000000 is outside the range of 'seconds'");
}

TEST_CASE("includes nest 32 levels deep") {
  const TemporaryDirectory files;
  for (int i = 1; i <= 33; ++i) {
    files.write(fmt::format("{}.xml", i),
                fmt::format("<root lockstep=\"1\"><include path=\"{}.xml\"/></root>", i + 1));
  }
  files.write("34.xml", "<root lockstep=\"1\"/>");
  const auto told = [&](int first) {
    return Pipeline(fmt::format("<root lockstep=\"1\"><include path=\"{}.xml\"/>"
                                "<BehaviorTree ID=\"T\"><AlwaysSuccess/></BehaviorTree></root>",
                                first),
                    "", files / "main.xml")
        .told();
  };
  CHECK(told(3).empty());
  CHECK(told(2) == "1:35 error: includes are nested deeper than 32 levels");
}

}  // namespace
}  // namespace lockstep::host::test

// docs/nodes-and-attributes.md: "The file" to "Nodes in a file".
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "language/pipeline.h"
#include "unit/document/temporary_directory.h"

namespace lockstep::host::test {
namespace {

constexpr std::string_view kTwoTrees =
    R"(<root lockstep="1">
  <BehaviorTree ID="A"><Say text="a"/></BehaviorTree>
  <BehaviorTree ID="B"><Say text="b"/></BehaviorTree></root>)";

TEST_CASE("the root says the version of the language") {
  constexpr ClaimRow kRows[] = {
      {"the first element is root", R"(<!-- <root> --><tree/>)",
       "1:16 error: the first element must be 'root', not 'tree'"},
      {"the version is 1",
       R"(<root lockstep="2"><BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree></root>)",
       "1:17 error: version '2' of the language is not known"},
      {"without it the file is for BehaviorTree.CPP",
       R"(<root><BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree></root>)",
       "1:1 warning: without 'BTCPP_format' this is read as a file of version 3"},
      {"the attributes for editors are allowed",
       R"(<root lockstep="1" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
                xsi:noNamespaceSchemaLocation="../schema/lockstep.xsd">
            <BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree></root>)",
       ""},
      {"no others are",
       R"(<root lockstep="1" xsi:schemaLocation="a b"><BehaviorTree ID="T"><AlwaysSuccess/>
          </BehaviorTree></root>)",
       "1:20 error: 'root' has no attribute 'xsi:schemaLocation'"},
      {"comments stand anywhere, text nowhere",
       "<root lockstep=\"1\"><!-- a --><BehaviorTree ID=\"T\"><!-- b -->\n"
       "<AlwaysSuccess/>hello</BehaviorTree></root>",
       "2:17 error: text is not part of the language"},
      {"nothing else stands in the root",
       R"(<root lockstep="1"><BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree><TreeNodeModel/>
          </root>)",
       "1:72 error: unknown element 'TreeNodeModel' in 'root'"},
      {"but for what editors know of the nodes",
       R"(<root lockstep="1"><TreeNodesModel><Action ID="Dock"><input_port name="at">where</input_port>
          </Action></TreeNodesModel><BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree></root>)",
       ""},
      {"a file needs a tree", R"(<root lockstep="1"/>)", "1:1 error: there is no BehaviorTree"},
  };
  check_told(kRows);
}

TEST_CASE("the tree to run is the option's, else the attribute's, else the only one") {
  constexpr std::string_view kNamed =
      R"(<root lockstep="1" main_tree_to_execute="B"><BehaviorTree ID="A"><Say text="a"/>
         </BehaviorTree><BehaviorTree ID="B"><Say text="b"/></BehaviorTree></root>)";
  constexpr ClaimRow kRows[] = {
      {"the only tree", R"(<Say text="hello"/>)", "success 1: hello"},
      {"main_tree_to_execute", kNamed, "success 1: b"},
      {"--tree goes first", kNamed, "success 1: a", "tree=A"},
      {"of several one must be named", kTwoTrees, "1:1 error: several trees, and none is chosen"},
      {"--tree may do it", kTwoTrees, "success 1: b", "tree=B"},
      {"--tree names a tree", kTwoTrees, "error: --tree C: unknown tree", "tree=C"},
      {"main_tree_to_execute names a tree",
       R"(<root lockstep="1" main_tree_to_execute="Q"><BehaviorTree ID="T"><AlwaysSuccess/>
          </BehaviorTree></root>)",
       "1:42 error: unknown tree 'Q'"},
      {"main_tree_to_execute may be an argument",
       R"(<root lockstep="1" main_tree_to_execute="${which}"><arg name="which" default="A"/>
          <BehaviorTree ID="A"><Say text="a"/></BehaviorTree>
          <BehaviorTree ID="B"><Say text="b"/></BehaviorTree></root>)",
       "success 1: b", "arg.which=B"},
  };
  check_runs(kRows);
}

TEST_CASE("included files: their trees, their arguments, once each") {
  const TemporaryDirectory files;
  files.write("parts/grasp.xml",
              R"(<root lockstep="1" main_tree_to_execute="Nowhere"><arg name="what" default="cup"/>
                 <include path="more/say.xml"/>
                 <BehaviorTree ID="Grasp"><SubTree ID="Speak" text="${what}"/></BehaviorTree></root>)");
  files.write("parts/more/say.xml",
              R"(<root lockstep="1"><BehaviorTree ID="Speak"><Say text="{text}"/></BehaviorTree>
                 </root>)");
  files.write("cycle.xml", R"(<root lockstep="1"><include path="main.xml"/></root>)");
  const auto run = [&](std::string_view xml, std::string_view options = "") {
    return Pipeline(xml, options, files / "main.xml").run();
  };
  CHECK(run(R"(<root lockstep="1" main_tree_to_execute="Main"><include path="parts/grasp.xml"/>
               <include path="parts/../parts/grasp.xml"/>
               <BehaviorTree ID="Main"><SubTree ID="Grasp"/></BehaviorTree></root>)",
            "arg.what=door") == "success 1: door");
  CHECK(run(R"(<root lockstep="1"><include path="parts/grasp.xml"/></root>)",
            "tree=Speak "
            "set.text=hi") == "success 1: hi");
  files.write("uses.xml", R"(<root lockstep="1"><BehaviorTree ID="Use"><Say text="${who}"/>
                             </BehaviorTree></root>)");
  CHECK(
      run(R"(<root lockstep="1"><arg name="who" default="me"/><include path="uses.xml"/></root>)") ==
      "success 1: me");
  CHECK(run(R"(<root lockstep="1"><include path="parts/grasp.xml"/><arg name="what"/></root>)",
            "tree=Grasp arg.what=x")
            .find("argument 'what' is declared twice") != std::string::npos);
  const std::string main = files / "main.xml";
  const std::string cycle = files / "cycle.xml";
  CHECK(run("<root lockstep=\"1\">\n<include path=\"cycle.xml\"/>\n"
            "<BehaviorTree ID=\"T\"><AlwaysSuccess/></BehaviorTree></root>") ==
        fmt::format("1:35 error: include cycle: {0} -> {1} -> {0}", main, cycle));
  CHECK(run("<root lockstep=\"1\">\n<include path=\"no.xml\"/>\n"
            "<BehaviorTree ID=\"T\"><AlwaysSuccess/></BehaviorTree></root>") ==
        fmt::format("2:16 error: cannot read '{}': No such file or directory", files / "no.xml"));
}

TEST_CASE("plugin, BehaviorTree and their attributes") {
  constexpr ClaimRow kRows[] = {
      {"a tree names plugins, never paths",
       R"(<root lockstep="1"><plugin name="robot" path="robot.so"/>
          <BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree></root>)",
       "1:41 error: 'plugin' has no attribute 'path'"},
      {"a plugin may be named twice",
       R"(<root lockstep="1"><plugin name="robot"/><plugin name="robot"/>
          <BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree></root>)",
       ""},
      {"a tree has one root node, and an ID",
       "<root lockstep=\"1\">\n<BehaviorTree ID=\"A\"/>\n<BehaviorTree ID=\"B\"><AlwaysSuccess/>"
       "<AlwaysSuccess/></BehaviorTree>\n<BehaviorTree><AlwaysSuccess/></BehaviorTree>\n"
       "<BehaviorTree ID=\"C/D\"><AlwaysSuccess/></BehaviorTree></root>",
       "1:1 error: several trees, and none is chosen\n"
       "2:1 error: the tree 'A' is empty\n"
       "3:38 error: the tree 'B' has more than one root node\n"
       "4:1 error: 'BehaviorTree' needs the attribute 'ID'\n"
       "5:19 error: the ID 'C/D' contains '/'"},
      {"an empty tree is reported once, not where it is used",
       "<root lockstep=\"1\" main_tree_to_execute=\"B\">\n<BehaviorTree ID=\"A\"/>\n"
       "<BehaviorTree ID=\"B\"><SubTree ID=\"A\"/></BehaviorTree></root>",
       "2:1 error: the tree 'A' is empty"},
      {"trees without an ID are reported once each",
       "<root lockstep=\"1\">\n<BehaviorTree><AlwaysSuccess/></BehaviorTree>\n<BehaviorTree>"
       "<AlwaysSuccess/></BehaviorTree></root>",
       "2:1 error: 'BehaviorTree' needs the attribute 'ID'\n"
       "3:1 error: 'BehaviorTree' needs the attribute 'ID'"},
      {"an empty tree without an ID", "<root lockstep=\"1\"><BehaviorTree/></root>",
       "1:20 error: 'BehaviorTree' needs the attribute 'ID'\n1:20 error: the tree '' is empty"},
      {"IDs are distinct",
       "<root lockstep=\"1\">\n<BehaviorTree ID=\"A\"><AlwaysSuccess/></BehaviorTree>\n"
       "<BehaviorTree ID=\"A\"><AlwaysSuccess/></BehaviorTree></root>",
       "3:19 error: a tree 'A' exists already"},
      {"trees that nobody uses are checked too",
       "<root lockstep=\"1\" main_tree_to_execute=\"A\"><BehaviorTree ID=\"A\"><AlwaysSuccess/>"
       "</BehaviorTree>\n<BehaviorTree ID=\"B\"><Inverter/></BehaviorTree></root>",
       "2:22 error: 'Inverter' needs exactly one child"},
      {"a remark is allowed on trees and nodes",
       R"(<root lockstep="1"><BehaviorTree ID="A" _description="a"><AlwaysSuccess _description="b"/>
          </BehaviorTree></root>)",
       ""},
  };
  check_told(kRows);
}

TEST_CASE("nodes: compact and explicit form") {
  constexpr ClaimRow kRows[] = {
      {"the explicit form is the same node",
       R"(<Control ID="Sequence" memory="true"><Decorator ID="Inverter"><Condition ID="IsOpen"/>
          </Decorator><Action ID="Say" text="done"/></Control>)",
       ""},
      {"the explicit form needs an ID", R"(<Action text="x"/>)",
       "2:1 error: 'Action' needs the attribute 'ID'"},
      {"the explicit form names the kind", R"(<Action ID="IsOpen"/>)",
       "2:13 error: 'IsOpen' is not of the kind 'Action'"},
      {"the compact form has no ID", R"(<Sequence ID="x"><AlwaysSuccess/></Sequence>)",
       "2:11 error: 'Sequence' has no parameter 'ID'"},
      {"unknown nodes", R"(<Sequnce><AlwaysSuccess/></Sequnce>)",
       "2:1 error: unknown node 'Sequnce'"},
      {"a tree's ID is not a tag", R"(<Grasp/>)", "2:1 error: unknown node 'Grasp'"},
      {"tags are case-sensitive", R"(<sequence><AlwaysSuccess/></sequence>)",
       "2:1 error: unknown node 'sequence'"},
      {"control nodes need a child, decorators exactly one, leaves none",
       "<Sequence>\n<Fallback/>\n<Inverter><AlwaysSuccess/>\n<AlwaysSuccess/></Inverter>\n"
       "<Wait seconds=\"1\"><AlwaysSuccess/></Wait>\n</Sequence>",
       "3:1 error: 'Fallback' needs a child\n"
       "5:1 error: 'Inverter' has more than one child\n"
       "6:19 error: 'Wait' cannot have children"},
  };
  check_told(kRows);
}

TEST_CASE("names and paths") {
  constexpr ClaimRow kRows[] = {
      {"the tree's ID, then names from its root node down",
       R"(<Sequence name="open"><Wait name="arm" seconds="1"/></Sequence>)", "T/open T/open/arm"},
      {"a node without a name has its id",
       R"(<Sequence><Action ID="Wait" seconds="1"/></Sequence>)", "T/Sequence T/Sequence/Wait"},
      {"equal siblings are numbered from the second",
       R"(<Parallel name="p"><Wait seconds="1"/><Wait seconds="1"/>
          <Wait name="Wait" seconds="1"/></Parallel>)",
       "T/p T/p/Wait T/p/Wait#2 T/p/Wait#3"},
      {"a name that looks numbered takes that number",
       R"(<Parallel name="p"><Wait name="a#2" seconds="1"/><Wait name="a" seconds="1"/>
          <Wait name="a" seconds="1"/></Parallel>)",
       "T/p T/p/a#2 T/p/a T/p/a#3"},
      {"or gets one itself where it is taken",
       R"(<Parallel name="p"><Wait name="a" seconds="1"/><Wait name="a" seconds="1"/>
          <Wait name="a#2" seconds="1"/><Wait name="a" seconds="1"/>
          <Wait name="a#2#2" seconds="1"/></Parallel>)",
       "T/p T/p/a T/p/a#2 T/p/a#2#2 T/p/a#3 T/p/a#2#2#2"},
      {"equal names elsewhere are not",
       R"(<Parallel name="p"><Inverter><Wait seconds="1"/></Inverter><Wait seconds="1"/>
          </Parallel>)",
       "T/p T/p/Inverter T/p/Inverter/Wait T/p/Wait"},
      {"a SubTree is called as the tree that it names, and that tree's nodes are under it",
       R"(<root lockstep="1" main_tree_to_execute="M"><BehaviorTree ID="M">
          <Sequence name="s"><SubTree ID="G"/><SubTree ID="G" name="again"/></Sequence>
          </BehaviorTree><BehaviorTree ID="G"><AlwaysSuccess/></BehaviorTree></root>)",
       "M/s M/s/G M/s/G/AlwaysSuccess M/s/again M/s/again/AlwaysSuccess"},
      {"a name holds no '/'", R"(<Wait name="a/b" seconds="1"/>)",
       "2:13 error: the name 'a/b' contains '/'"},
      {"nor is it empty", R"(<Wait name="" seconds="1"/>)", "2:13 error: the name is empty"},
      {"blanks and any letters are fine", R"(<Wait name="linker Arm, größer" seconds="1"/>)",
       "T/linker Arm, größer"},
  };
  check_paths(kRows);
}

}  // namespace
}  // namespace lockstep::host::test

#include <catch2/catch.hpp>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

const std::string kShowTree = R"(<root lockstep="1" main_tree_to_execute="Main">
  <plugin name="motion"/>
  <arg name="delta" default="0.1"/>
  <BehaviorTree ID="Main">
    <Sequence name="all" memory="true">
      <ParallelRelative delta="${delta}"><Action ID="Advance" name="arm" step="{pace}"/></ParallelRelative>
      <SubTree ID="Part" pace="{pace}"/>
      <ParallelAbsolute barrier_count="2"><Wait seconds="1" name="a &quot;b\&lt;&amp;`#"/></ParallelAbsolute>
    </Sequence>
  </BehaviorTree>
  <BehaviorTree ID="Part"><Inverter><AlwaysFailure/></Inverter></BehaviorTree>
</root>)";

struct Shown {
  TemporaryDirectory directory;
  std::string file = directory.file("tree.xml", kShowTree);
};

}  // namespace

TEST_CASE("show draws the expanded tree, with boxes or ASCII as the locale can") {
  const Shown it;
  const Outcome boxes =
      run({.arguments = {"show", it.file}, .environment = {{"LC_ALL", "C.UTF-8"}}});
  CHECK(boxes.code == 0);
  CHECK(boxes.out ==
        "Main\n"
        "└── Sequence 'all' memory=\"true\"\n"
        "    ├── ParallelRelative delta=\"0.1\"\n"
        "    │   └── Advance 'arm' step=\"{pace}\"\n"
        "    ├── SubTree 'Part' ID=\"Part\" pace=\"{pace}\"\n"
        "    │   └── Inverter\n"
        "    │       └── AlwaysFailure\n"
        "    └── ParallelAbsolute barrier_count=\"2\"\n"
        "        └── Wait 'a \"b\\<&`#' seconds=\"1\"\n");
  const Outcome ascii =
      run({.arguments = {"show", it.file, "--arg", "delta=0.5"}, .environment = {{"LC_ALL", "C"}}});
  CHECK(contains(ascii.out, "    |-- ParallelRelative delta=\"0.5\"\n    |   `-- Advance"));
  CHECK(!contains(ascii.out, "└"));
}

TEST_CASE("show --tree draws another tree") {
  const Shown it;
  const Outcome outcome = run_lockstep({"show", it.file, "--tree", "Part"});
  CHECK(outcome.out == "Part\n`-- Inverter\n    `-- AlwaysFailure\n");
}

TEST_CASE("show --format dot: signs, barriers and delta, shapes, nothing of a label is markup") {
  const Shown it;
  const Outcome outcome = run_lockstep({"show", it.file, "--format", "dot"});
  CHECK(outcome.code == 0);
  CHECK(outcome.out.rfind("digraph \"Main\" {\n", 0) == 0);
  CHECK(contains(outcome.out, "n0 [shape=square, label=\"→\\nall\\nmemory=\\\"true\\\"\"];"));
  CHECK(contains(outcome.out, "label=\"⇉R\\nΔ = 0.1\""));
  CHECK(contains(outcome.out, "label=\"⇉A\\n{0.5, 1}\""));
  CHECK(contains(outcome.out, "[shape=box, label=\"Wait\\na \\\"b\\\\<&amp;`#\\nseconds"));
  CHECK(contains(outcome.out, "n0 -> n1;\n"));
  CHECK(contains(outcome.out, "n1 -> n2;\n"));
  CHECK(contains(outcome.out, "[shape=diamond, label=\"Inverter\"]"));
}

TEST_CASE("show --format mermaid: nothing of a label is markup") {
  const Shown it;
  const Outcome outcome = run_lockstep({"show", it.file, "--format", "mermaid"});
  CHECK(outcome.code == 0);
  CHECK(outcome.out.rfind("flowchart TD\n", 0) == 0);
  CHECK(contains(outcome.out, "n1[\"⇉R<br/>Δ = 0.1\"]\n  n0 --- n1\n"));
  CHECK(contains(outcome.out, "Wait<br/>a #34;b#92;#60;#38;#96;#35;<br/>"));
  CHECK(contains(outcome.out, "{{\"Inverter\"}}"));
}

TEST_CASE("conditions are ellipses") {
  const TemporaryDirectory directory;
  const std::string plugin = LOCKSTEP_BINARY_DIR "/tests/abi/plugins/condition_running.so";
  const std::string file = directory.file(
      "tree.xml", "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><Probe/></BehaviorTree></root>");
  const auto shown = [&](const std::string& format) {
    return run_lockstep({"show", file, "--plugin", plugin, "--format", format}).out;
  };
  CHECK(contains(shown("dot"), "[shape=ellipse, label=\"Probe\"]"));
  CHECK(contains(shown("mermaid"), "n0([\"Probe\"])"));
}

TEST_CASE("show does not run the init of a plugin, and draws nothing of an invalid tree") {
  const TemporaryDirectory directory;
  const std::string plugin = LOCKSTEP_BINARY_DIR "/tests/abi/plugins/init_refuses.so";
  const std::string file = directory.file(
      "tree.xml", "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><Probe/></BehaviorTree></root>");
  CHECK(run_lockstep({"show", file, "--plugin", plugin}).code == 0);
  CHECK(run_lockstep({"run", file, "--plugin", plugin}).code == 4);
  const Outcome invalid = run_lockstep({"show", file});
  CHECK(invalid.code == 3);
  CHECK(invalid.out.empty());
  CHECK(contains(invalid.err, "unknown node 'Probe'"));
}

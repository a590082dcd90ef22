#include <catch2/catch.hpp>
#include <filesystem>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

const std::string kSchema = LOCKSTEP_SOURCE_DIR "/schema/lockstep.xsd";

Outcome xmllint(const std::string& schema, const std::string& tree) {
  const Outcome outcome =
      run({.arguments = {"--noout", "--schema", schema, tree}, .program = "xmllint"});
  REQUIRE(outcome.code != 127);  // not installed: Debian libxml2-utils
  return outcome;
}

std::string around(const std::string& node) {
  return "<root lockstep=\"1\"><BehaviorTree ID=\"A\">" + node + "</BehaviorTree></root>";
}

// Those in our language.
std::vector<std::string> trees_below(const std::string& directory) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    const std::string file = entry.path().string();
    if (!file.ends_with(".xml") || file.ends_with(".test.xml")) continue;
    if (file.ends_with(".leaves.xml")) continue;
    if (contains(read_file(file), "<root BTCPP_format")) continue;
    files.push_back(file);
  }
  return files;
}

}  // namespace

TEST_CASE("schema/lockstep.xsd is what the program prints") {
  const Outcome outcome = run_lockstep({"schema"});
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  INFO("schema/lockstep.xsd is stale: lockstep schema > schema/lockstep.xsd");
  CHECK((outcome.out == read_file(kSchema)));
}

TEST_CASE("schema/leaves.xsd is what the program prints, and describes leaf files") {
  const std::string schema = LOCKSTEP_SOURCE_DIR "/schema/leaves.xsd";
  INFO("schema/leaves.xsd is stale: lockstep schema --leaves > schema/leaves.xsd");
  CHECK((run_lockstep({"schema", "--leaves"}).out == read_file(schema)));
  const TemporaryDirectory directory;
  const auto code = [&](const std::string& rows) {
    return xmllint(schema, directory.file("t.leaves.xml", "<leaves lockstep=\"1\" rate=\"10\">" +
                                                              rows + "</leaves>"))
        .code;
  };
  CHECK(code(R"(<tree ends="no"/><fact name="f" changes="never"/><leaf of="A" fact="f"
    result="success;fault" ticks="2..inf" step="-1..2" held="-1..0" progress="grid:20"
    out.place="a|b" writes="start" sets="f=true;g=false" finish="full" ends="no"/>
    <accept finding="trap" because="x"/>)") == 0);
  for (const std::string wrong :
       {"<leef/>", R"(<leaf of="A" ticks="a"/>)", R"(<leaf of="A" result="succes"/>)", R"(<tree/>)",
        R"(<fact name="f" changes="at will"/>)"}) {
    INFO(wrong);
    CHECK(code(wrong) != 0);
  }
}

TEST_CASE("xmllint accepts every tree that ships and every good one of the tests") {
  auto files = trees_below(LOCKSTEP_SOURCE_DIR "/trees");
  REQUIRE(files.size() > 3);
  const auto good = trees_below(LOCKSTEP_SOURCE_DIR "/tests/trees/good");
  REQUIRE(good.size() >= 10);
  files.insert(files.end(), good.begin(), good.end());
  for (const std::string& file : files) {
    const Outcome outcome = xmllint(kSchema, file);
    INFO(outcome.err);
    CHECK(outcome.code == 0);
  }
}

TEST_CASE("what check accepts, the schema accepts") {
  const TemporaryDirectory directory;
  const std::string accepted[] = {
      around("<Wait seconds=\" +.5e0 \" name=\"a b\" _description=\"\"/>"),
      around("<Wait seconds=\"5.\">\n  <!-- nothing -->\n</Wait>"),
      around("<ParallelAbsolute barriers=\"0.25,0.5 .75;1.\"><AlwaysSuccess/></ParallelAbsolute>"),
      around("<ParallelAbsolute barriers=\"5e-1\"><AlwaysSuccess/></ParallelAbsolute>"),
      around("<ParallelAbsolute barriers=\"\"><AlwaysSuccess/></ParallelAbsolute>"),
      around("<Sequence "
             "memory=\"1\"><AlwaysSuccess/><Inverter><AlwaysFailure/></Inverter></Sequence>"),
      around("<Control ID=\"Sequence\"><Action ID=\"AlwaysSuccess\"/></Control>"),
      around("<Decorator ID=\"Repeat\" times=\"3\"><AlwaysSuccess/></Decorator>"),
      "<root lockstep=\"1\"><arg name=\"s\" default=\"1\"/>"
      "<BehaviorTree ID=\"A\"><Wait seconds=\"${s}\"/></BehaviorTree></root>",
      "<root lockstep=\"1\" main_tree_to_execute=\"A\" "
      "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
      "xsi:noNamespaceSchemaLocation=\"lockstep.xsd\"><BehaviorTree ID=\"A\">"
      "<SubTree ID=\"B\" _autoremap=\"true\"/></BehaviorTree>"
      "<BehaviorTree ID=\"B\"><AlwaysSuccess/></BehaviorTree></root>"};
  for (const std::string& text : accepted) {
    const std::string file = directory.file("tree.xml", text);
    const Outcome checked = run_lockstep({"check", file});
    const Outcome outcome = xmllint(kSchema, file);
    INFO(text << "\n" << outcome.err << checked.err);
    CHECK(checked.code == 0);
    CHECK(outcome.code == 0);
  }
}

TEST_CASE("what check refuses, the schema refuses where it can say it") {
  const TemporaryDirectory directory;
  const std::string refused[] = {
      around("<Sequence memroy=\"true\"><AlwaysSuccess/></Sequence>"),
      around("<ParallelRelative><AlwaysSuccess/></ParallelRelative>"),
      around("<ParallelAbsolute barriers=\"1\" "
             "at_barrier=\"wat\"><AlwaysSuccess/></ParallelAbsolute>"),
      around("<ParallelRelative delta=\"1.5\"><AlwaysSuccess/></ParallelRelative>"),
      around("<ParallelAbsolute barriers=\"-0.5;0.5\"><AlwaysSuccess/></ParallelAbsolute>"),
      around("<ParallelAbsolute barriers=\"0.5;1.5\"><AlwaysSuccess/></ParallelAbsolute>"),
      around("<Timeout seconds=\"0\"><AlwaysSuccess/></Timeout>"),
      around("<Repeat times=\"1.5\"><AlwaysSuccess/></Repeat>"),
      around("<Sequence memory=\"{m}\"><AlwaysSuccess/></Sequence>"),
      around("<Wait seconds=\"INF\"/>"),
      around("<Sequence memory=\"yes\"><AlwaysSuccess/></Sequence>"),
      around("<Inverter><AlwaysSuccess/><AlwaysSuccess/></Inverter>"),
      around("<Wait seconds=\"1\"><AlwaysSuccess/></Wait>"),
      around("<Sequence/>"),
      around("<Sequence>text<AlwaysSuccess/></Sequence>"),
      around("<SubTree/>"),
      around("<Action/>"),
      around("<AlwaysSuccess name=\"\"/>"),
      around("<AlwaysSuccess name=\"a/b\"/>"),
      around("<Sequence><AlwaysSuccess/><arg name=\"x\"/></Sequence>"),
      around("<Sequence><BehaviorTree ID=\"B\"><AlwaysSuccess/></BehaviorTree></Sequence>"),
      around("<Unknown><Sequence/></Unknown>"),
      around("<AlwaysSuccess/><AlwaysSuccess/>"),
      around(""),
      "<root lockstep=\"2\"><BehaviorTree ID=\"A\"><AlwaysSuccess/></BehaviorTree></root>",
      "<root lockstep=\"1\" x=\"\"><BehaviorTree ID=\"A\"><AlwaysSuccess/></BehaviorTree></root>",
      "<root lockstep=\"1\"><BehaviorTree><AlwaysSuccess/></BehaviorTree></root>",
      "<root lockstep=\"1\"><Sequence/><BehaviorTree "
      "ID=\"A\"><AlwaysSuccess/></BehaviorTree></root>",
      "<root lockstep=\"1\"><plugin name=\"motion\"><x/></plugin></root>",
      "<root lockstep=\"1\"><arg/></root>",
      "<BehaviorTree ID=\"A\"><AlwaysSuccess/></BehaviorTree>"};
  constexpr int kInvalid = 3;  // of both programs
  for (const std::string& text : refused) {
    const std::string file = directory.file("tree.xml", text);
    INFO(text);
    CHECK(run_lockstep({"check", file}).code == kInvalid);
    CHECK(xmllint(kSchema, file).code == kInvalid);
  }
}

TEST_CASE("leaves of plugins are open content until the schema knows them") {
  const TemporaryDirectory directory;
  const Outcome schema = run_lockstep({"schema", "--plugin", "motion"});
  CHECK(schema.code == 0);
  const std::string knowing = directory.file("motion.xsd", schema.out);
  const std::string wrong = directory.file("tree.xml", around("<Advance step=\"fast\"/>"));
  CHECK(xmllint(kSchema, wrong).code == 0);
  CHECK(xmllint(knowing, wrong).code == 3);
  for (const char* step : {"0.5", "{speed}", "${speed}"}) {
    const std::string good =
        directory.file("good.xml", around("<Advance step=\"" + std::string(step) + "\"/>"));
    CHECK(xmllint(knowing, good).code == 0);
  }
}

TEST_CASE("a strict schema refuses what it does not know") {
  const TemporaryDirectory directory;
  const auto schema = [&](const std::string& name, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"schema", "--strict"});
    const Outcome outcome = run_lockstep(arguments);
    CHECK(outcome.code == 0);
    return directory.file(name, outcome.out);
  };
  const std::string motion = schema("motion.xsd", {"--plugin", "motion"});
  const std::string bare = schema("bare.xsd", {});
  struct Row {
    std::string node;
    int with_motion, bare, open;
  };
  const Row rows[] = {
      {"<Sequence><Advance/></Sequence>", 0, 3, 0},
      {"<Sequence><Advnce/></Sequence>", 3, 3, 0},
      {"<Sequnce><Advance/></Sequnce>", 3, 3, 0},
      {"<Wiat seconds=\"1\"/>", 3, 3, 0},
      {"<Action ID=\"Advance\"/>", 0, 3, 0},
      {"<Action ID=\"Advnce\"/>", 3, 3, 0},
      {"<Action ID=\"${which}\"/>", 0, 0, 0},
      {"<Condition ID=\"Advance\"/>", 3, 3, 0},
      {"<Control ID=\"Sequence\"><AlwaysSuccess/></Control>", 0, 0, 0},
      {"<Control ID=\"Sequnce\"><AlwaysSuccess/></Control>", 3, 3, 0},
      {"<Decorator ID=\"Inverter\"><AlwaysSuccess/></Decorator>", 0, 0, 0},
      {"<SubTree ID=\"B\" door=\"{door}\"/>", 0, 0, 0},
      {"<BehaviorTree ID=\"B\"/>", 3, 3, 3},
  };
  for (const Row& row : rows) {
    const std::string file = directory.file("tree.xml", around(row.node));
    INFO(row.node);
    CHECK(xmllint(motion, file).code == row.with_motion);
    CHECK(xmllint(bare, file).code == row.bare);
    CHECK(xmllint(kSchema, file).code == row.open);
  }
}

TEST_CASE("a strict schema of all plugins accepts every tree that ships") {
  const TemporaryDirectory directory;
  const Outcome schema = run_lockstep({"schema", "--strict", "--plugin", "motion", "--plugin",
                                       "r1sim", "--plugin", "fetch", "--plugin", "nav", "--plugin",
                                       LOCKSTEP_BINARY_DIR "/plugins/exec.py"});
  const std::string strict = directory.file("strict.xsd", schema.out);
  const auto files = trees_below(LOCKSTEP_SOURCE_DIR "/trees");
  REQUIRE(files.size() > 3);
  for (const std::string& file : files) {
    const Outcome outcome = xmllint(strict, file);
    INFO(outcome.err);
    CHECK(outcome.code == 0);
  }
}

TEST_CASE("recordings keep schema/recording.schema.json, and what is no line does not") {
  if (run({.arguments = {"-c", "import jsonschema"}, .program = "/usr/bin/python3"}).code != 0)
    return;
  const TemporaryDirectory directory;
  const std::string file = directory.path("run.jsonl");
  const std::string tree = LOCKSTEP_SOURCE_DIR "/trees/door_pulling.xml";
  REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--record", file}).code == 0);
  const Outcome validated =
      run({.arguments = {"-c", R"(
import json, jsonschema, sys
validator = jsonschema.Draft7Validator(json.load(open(sys.argv[1])))
lines = [json.loads(line) for line in open(sys.argv[2])]
for line in lines: validator.validate(line)
wrong = [{}, {"tick": 0}, {**lines[1], "nodes": [[0, "runs", 0, 1, 0]]}, {**lines[0], "clock": "sun"}]
print(len(lines) > 100, any(map(validator.is_valid, wrong)))
)",
                         LOCKSTEP_SOURCE_DIR "/schema/recording.schema.json", file},
           .program = "/usr/bin/python3"});
  INFO(validated.err);
  CHECK(validated.out == "True False\n");
}

// The first five minutes of docs/programs.md, word for word; and what holds of every leaf that is a
// program.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <regex>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

const std::string kProgramsFolder = LOCKSTEP_SOURCE_DIR "/tests/programs";

// The page's first block of this kind.
std::string first_block(const std::string& page, const std::string& kind) {
  const std::string open = "\n```" + kind + "\n";
  const auto begin = page.find(open) + open.size();
  return page.substr(begin, page.find("```\n", begin) - begin);
}

// The recording of the door's tree, with leaves that go on by a step for each tick. It does not
// tell which plugin they are from.
std::string door_recording(const std::string& plugin, const std::string& path) {
  const TemporaryDirectory work;
  const std::string file = work.path("run.jsonl");
  const Outcome outcome =
      run({.arguments = {"run", "-", "--plugin-path", path, "--clock", "virtual", "--record", file},
           .input = "<root lockstep=\"1\"><plugin " + plugin +
                    "/><BehaviorTree ID=\"Open\"><Sequence name=\"open\" memory=\"true\">"
                    "<Advance name=\"reach\" step=\"0.08\"/>"
                    "<ParallelAbsolute name=\"pull\" barriers=\"0.25;0.5;0.75\">"
                    "<Advance name=\"arm\" step=\"0.02\"/><Advance name=\"base\" step=\"0.05\"/>"
                    "</ParallelAbsolute><Advance name=\"release\" step=\"0.2\"/>"
                    "</Sequence></BehaviorTree></root>"});
  INFO(plugin << outcome.err);
  REQUIRE(outcome.code == 0);
  // Each implementation has some ports of its own.
  return std::regex_replace(read_file(file), std::regex(R"(,"ports":\{[^}]*\})"), "");
}

bool is_installed(const std::string& program) {
  return run({.arguments = {"-c", "command -v " + program},
              .environment = {{"PATH", "/usr/bin:/bin"}},
              .program = "/bin/sh"})
             .code == 0;
}

}  // namespace

TEST_CASE("docs/programs.md: what it says works word for word") {
  const std::string page = read_file(LOCKSTEP_SOURCE_DIR "/docs/programs.md");
  const TemporaryDirectory home;
  chmod(home.file("sweep.py", first_block(page, "python")).c_str(), 0755);
  home.file("tree.xml", first_block(page, "xml"));
  const std::string script = "cd '" + home.path("") + "'\n" + first_block(page, "sh");
  const Outcome outcome = run({.arguments = {"-e", "-c", script},
                               .environment = {{"PATH", LOCKSTEP_BINARY_DIR ":/usr/bin:/bin"}},
                               .program = "/bin/sh"});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err, "Sweep: waits for Advance at barrier 0.5"));
}

TEST_CASE("leaves in Python, bash, node, C and Rust give the recording of those in C++") {
  const std::string expected = door_recording("name=\"motion\"", kProgramsFolder);
  CHECK(expected.size() > 1000);
  for (const std::string program : {"advance.py", "advance_class.py", "advance.sh", "advance.js"}) {
    if (program.ends_with(".js") && !is_installed("node")) continue;
    CHECK(door_recording("name=\"motion\" program=\"" + program + "\"", kProgramsFolder) ==
          expected);
  }
  CHECK(door_recording("name=\"advance_c\"", LOCKSTEP_BINARY_DIR "/tests/cli") == expected);
  if (!is_installed("rustc")) return;
  const TemporaryDirectory built;
  const std::string source = built.file("advance.rs", read_file(kProgramsFolder + "/advance.rs"));
  built.file("lockstep.rs",
             read_file(LOCKSTEP_SOURCE_DIR
                       "/interpreter/author/scaffold/templates/plugin/lockstep.rs.in"));
  const Outcome compiled =
      run({.arguments = {"--edition", "2021", "-O", "-D", "warnings", "--crate-type", "cdylib",
                         "-o", built.path("advance.so"), source},
           .program = "/usr/bin/rustc"});
  INFO(compiled.err);
  REQUIRE(compiled.code == 0);
  CHECK(door_recording("name=\"advance\"", built.path("")) == expected);
  const std::string tree =
      built.file("tree.xml",
                 "<root lockstep=\"1\"><plugin name=\"advance\"/><BehaviorTree ID=\"Main\">"
                 "<Advance step=\"0\"/></BehaviorTree></root>");
  const Outcome panic =
      run_lockstep({"run", tree, "--clock", "virtual", "--plugin-path", built.path("")});
  CHECK(panic.code == 5);
  CHECK(contains(panic.err,
                 "(Advance of plugin 'advance') failed in tick 0 at 0.000 s: port 'step' is 0"));
}

TEST_CASE("nodes has the leaves and ports of a program") {
  const Outcome outcome = run_lockstep(
      {"nodes", "Advance", "--run-programs", "--plugin", kProgramsFolder + "/advance.py"});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "step"));
  CHECK(contains(outcome.out, "0.01"));
}

TEST_CASE("what lockstep and a program say keeps schema/program.schema.json") {
  const TemporaryDirectory directory;
  const std::string said = directory.path("lines");
  const std::string shapes = directory.file(
      "shapes.xml",
      R"(<root lockstep="1"><plugin name="tee" program="tee.py"/><BehaviorTree ID="Main">)"
      R"(<Sequence><Shape kind="round" size.radius="2" out.area="{a}"/>)"
      R"(<Box kind="square" size.side="{a}"/></Sequence></BehaviorTree></root>)");
  const Outcome described =
      run({.arguments = {"run", shapes, "--plugin-path", kProgramsFolder, "--clock", "virtual"},
           .environment = {{"LINES", said}, {"PROGRAM", "shapes_class.py"}}});
  INFO(described.err);
  CHECK(described.code == 0);
  const std::string tree = directory.file(
      "tree.xml",
      R"(<root lockstep="1"><plugin name="tee" program="tee.py"/><plugin name="motion"/>)"
      R"(<BehaviorTree ID="Main"><ParallelAbsolute barriers="0.005"><Steady name="a"/>)"
      R"(<Advance step="0.0005"/></ParallelAbsolute></BehaviorTree></root>)");
  const Outcome outcome = run({.arguments = {"run", tree, "--plugin-path", kProgramsFolder,
                                             "--clock", "virtual", "--max-ticks", "30"},
                               .environment = {{"LINES", said}}});
  INFO(outcome.err);
  CHECK(outcome.code == 124);
  if (run({.arguments = {"-c", "import jsonschema"}, .program = "/usr/bin/python3"}).code != 0)
    return;
  const Outcome validated =
      run({.arguments = {kProgramsFolder + "/validate.py",
                         LOCKSTEP_SOURCE_DIR "/schema/program.schema.json", said},
           .program = "/usr/bin/python3"});
  INFO(validated.err);
  CHECK(
      validated.out ==
      "create describe destroy done halt lockstep log pause ports resume start status tick True\n");
}

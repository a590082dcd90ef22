#include <catch2/catch.hpp>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;
using nlohmann::json;

namespace {

json listed(std::vector<std::string> more) {
  std::vector<std::string> arguments{"nodes", "--format", "json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = run_lockstep(arguments);
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  return parse_json(outcome.out);
}

std::size_t characters(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

}  // namespace

TEST_CASE("nodes as text has all built-ins in groups, in at most 100 columns") {
  const Outcome outcome = run_lockstep({"nodes"});
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  for (const json& node : listed({})) {
    CHECK(contains(outcome.out, "\n  " + node["id"].get<std::string>() + " ("));
  }
  for (const std::string& line : lines(outcome.out)) CHECK(characters(line) <= 100);
  CHECK(outcome.out.find("Control nodes") < outcome.out.find("Decorators"));
  CHECK(!contains(outcome.out, "\x1b"));
}

TEST_CASE("nodes as JSON says what the checker knows") {
  const json nodes = listed({"ParallelAbsolute"});
  REQUIRE(nodes.size() == 1);
  const json& node = nodes[0];
  CHECK(node["category"] == "control node");
  CHECK(node["children"] == json{{"min", 1}, {"max", nullptr}});
  const json& barriers = node["parameters"][0];
  CHECK(barriers["name"] == "barriers");
  CHECK(barriers["type"] == "list of double");
  CHECK(barriers["range"] == json{{"min", 0.0}, {"max", 1.0}, {"min_excluded", false}});
  CHECK(barriers["required"] == false);
  CHECK(barriers["default"].is_null());
  CHECK(barriers["blackboard"] == true);
  const json& at_barrier = node["parameters"][2];
  CHECK(at_barrier["choices"] == json{"wait", "tick"});
  CHECK(at_barrier["default"] == "wait");
  CHECK(listed({"Wait"})[0]["parameters"][0]["unit"] == "s");
  CHECK(listed({"Sequence"})[0]["parameters"][0]["blackboard"] == false);  // memory
  CHECK(listed({"Inverter"})[0]["children"] == json{{"min", 1}, {"max", 1}});
  CHECK(listed({"SubTree"})[0]["children"] == json{{"min", 0}, {"max", 0}});
}

TEST_CASE("leaves of plugins are listed with their ports, found by file and by name") {
  const std::string file = LOCKSTEP_BINARY_DIR "/plugins/motion.so";
  const json by_file = listed({"Advance", "--plugin", file});
  CHECK(by_file == listed({"Advance", "--plugin", "motion"}));
  CHECK(by_file ==
        listed({"Advance", "--plugin", "motion", "--plugin-path", LOCKSTEP_BINARY_DIR "/plugins"}));
  CHECK(by_file[0]["plugin"] == "motion");
  CHECK(by_file[0]["parameters"][0]["blackboard"] == true);
  CHECK(by_file[0]["parameters"][0]["direction"] == "in");
  CHECK(listed({"--plugin", "motion"}).size() > listed({}).size());
  const std::string text = run_lockstep({"nodes", "--plugin", "motion"}).out;
  CHECK(contains(text, "\n  Advance ("));
  CHECK_FALSE(contains(text, "Sequence ("));
}

TEST_CASE("LOCKSTEP_PLUGIN_PATH is searched, after --plugin-path") {
  const TemporaryDirectory empty;
  const Invocation call{
      .arguments = {"nodes", "good", "--plugin", "good"},
      .environment = {{"LOCKSTEP_PLUGIN_PATH",
                       empty.path("none") + ":" LOCKSTEP_BINARY_DIR "/tests/abi/plugins"}}};
  CHECK(contains(run({.arguments = call.arguments}).err, "plugin 'good' is not found"));
  CHECK(!contains(run(call).err, "is not found"));
}

TEST_CASE("one node in full, and did you mean") {
  const Outcome one = run_lockstep({"nodes", "ParallelRelative"});
  CHECK(one.code == 0);
  CHECK(contains(one.out, "<ParallelRelative delta=\"…\"> … </ParallelRelative>"));
  CHECK(contains(one.out, "double, from 0 to 1, required"));
  CHECK(!contains(one.out, "Fallback"));
  const Outcome unknown = run_lockstep({"nodes", "Sequnce"});
  CHECK(unknown.code == 2);
  CHECK(unknown.out.empty());
  CHECK(contains(unknown.err, "unknown node 'Sequnce'"));
  CHECK(contains(unknown.err, "did you mean 'Sequence'?"));
}

TEST_CASE("a node of BehaviorTree.CPP is shown by its name") {
  const Outcome outcome = run_lockstep({"nodes", "Switch2"});
  CHECK(outcome.code == 0);
  CHECK(outcome.out.starts_with("Switch2"));
  CHECK(contains(outcome.out, "variable"));
}

TEST_CASE("a plugin that is refused ends nodes and schema with 4") {
  for (const std::string command : {"nodes", "schema"}) {
    const Outcome missing = run_lockstep({command, "--plugin", "/nonexistent.so"});
    CHECK(missing.code == 4);
    CHECK(missing.out.empty());
    CHECK(contains(missing.err, "'/nonexistent.so' does not exist"));
    CHECK(run_lockstep({command, "--plugin", "nonexistent"}).code == 4);
  }
}

TEST_CASE("docs/nodes.md is what the program prints") {
  const Outcome outcome = run_lockstep({"nodes", "--format", "markdown"});
  CHECK(outcome.code == 0);
  INFO("docs/nodes.md is stale: lockstep nodes --format markdown > docs/nodes.md");
  CHECK((outcome.out == read_file(LOCKSTEP_SOURCE_DIR "/docs/nodes.md")));
}

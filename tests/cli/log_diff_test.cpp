#include <catch2/catch.hpp>

#include "support/json.h"
#include "support/program.h"

using namespace lockstep::host::test;
using nlohmann::json;

namespace {

Outcome call(std::vector<std::string> arguments) {
  return run_lockstep(std::move(arguments));
}

std::string record(const TemporaryDirectory& directory, const std::string& name,
                   const std::string& step) {
  const std::string file = directory.path(name);
  const std::string tree = directory.file(
      name + ".xml",
      tree_text("<Sequence memory=\"true\"><Advance name=\"arm\" step=\"0.25\"/><Advance "
                "name=\"base\" step=\"" +
                step + "\"/></Sequence>"));
  REQUIRE(call({"run", tree, "--clock", "virtual", "--view", "none", "--record", file}).code == 0);
  return file;
}

}  // namespace

TEST_CASE("two recordings of the same run do not differ, though their files have other names") {
  const TemporaryDirectory directory;
  const std::string a = record(directory, "a", "0.5"), b = record(directory, "b", "0.5");
  const Outcome outcome = call({"log", "diff", a, b});
  CHECK(outcome.code == 0);
  CHECK(outcome.out == "");
  CHECK(outcome.err == "");
  const Outcome as_json = call({"log", "diff", a, b, "--json"});
  CHECK(as_json.code == 0);
  CHECK(parse_json(as_json.out)["same"] == true);
}

TEST_CASE("start values that differ are a difference of two recordings, whatever the ticks do") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("t.xml", R"(<root lockstep="1"><BehaviorTree ID="T"><Sequence>
<Script code="m := k &gt; 0"/><Script code="m := j &gt; 0"/></Sequence></BehaviorTree></root>)");
  const auto record = [&](const std::string& name, const char* k, const char* j) {
    const std::string file = directory.path(name);
    REQUIRE(call({"run", tree, "--clock", "virtual", "--view", "none", "--set", k, "--set", j,
                  "--record", file})
                .code == 0);
    return file;
  };
  const std::string a = record("a", "k=1", "j=1"), b = record("b", "k=2", "j=1");
  const Outcome outcome = call({"log", "diff", a, b});
  CHECK(outcome.code == 1);
  CHECK(outcome.out.starts_with(
      "--- " + a + "\n+++ " + b +
      "\n@@ header @@\n-start value k 1\n+start value k 2\n@@ tick 0 @@\n"));
  CHECK_FALSE(contains(outcome.out, "start value j"));
  CHECK(call({"log", "diff", a, record("c", "k=1", "j=1")}).out == "");
}

TEST_CASE("the first tick in which two runs differ, as text and as JSON") {
  const TemporaryDirectory directory;
  const std::string a = record(directory, "a", "0.5"), b = record(directory, "b", "0.25");
  const Outcome outcome = call({"log", "diff", a, b});
  CHECK(outcome.code == 1);
  const auto text = lines(outcome.out);
  REQUIRE(text.size() > 4);
  CHECK(text[0] == "--- " + a);
  CHECK(text[1] == "+++ " + b);
  CHECK(text[2].starts_with("@@ tick "));
  CHECK(contains(outcome.out,
                 "\n Main/Sequence/base\n-  success, progress 0.5, ticked\n"
                 "+  running, progress 0.25, ticked\n"));
  const json told = parse_json(call({"log", "diff", a, b, "--json"}).out);
  for (const json& node : told["first_tick"]["nodes"]) CHECK_FALSE(node["a"].contains("limit"));
  CHECK(told["same"] == false);
  CHECK(told["first_tick"]["nodes"].back()["path"] == "Main/Sequence/base");
  CHECK(told["first_tick"]["nodes"].back()["b"]["progress"] == 0.25);
  CHECK(told["ticks"]["a"] < told["ticks"]["b"]);
  CHECK(told["end"][0]["what"] == "ticks");
}

TEST_CASE("where times differ on the wall clock, log diff hints at --ignore-time") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text("<Advance step=\"0.5\"/>"));
  const auto record_at = [&](const std::string& name, const std::string& clock) {
    const std::string file = directory.path(name);
    call({"run", tree, "--clock", clock, "--view", "none", "--record", file, "--overrun",
          "catch-up"});
    return file;
  };
  const std::string a = record_at("a", "wall"), b = record_at("b", "wall");
  const Outcome outcome = call({"log", "diff", a, b});
  CHECK(outcome.code == 1);
  CHECK(contains(outcome.err, "note: on the wall clock no two runs have the same times\n"));
  CHECK(contains(outcome.err, "hint: --ignore-time "));
  const Outcome ignored = call({"log", "diff", a, b, "--ignore-time"});
  CHECK(ignored.err == "");
  const std::string c = record_at("c", "virtual"), d = record(directory, "d", "0.5");
  CHECK(call({"log", "diff", c, d}).err == "");
}

TEST_CASE("what log diff cannot read") {
  const TemporaryDirectory directory;
  const std::string a = record(directory, "a", "0.5");
  CHECK(call({"log", "diff", a, directory.path("missing")}).code == 2);
  CHECK(call({"log", "diff", a}).code == 2);
  CHECK(call({"log", "diff", "-", "-"}).code == 2);
  CHECK(call({"log", "diff", a, a, "--tolerance", "-1"}).code == 2);
  CHECK(call({"log", "diff", a, directory.file("none", "{}\n")}).code == 3);
  const std::string text = read_file(a);
  std::string damaged_text = text;
  damaged_text.insert(text.rfind("{\"end\""), "x\n");
  const Outcome damaged = call({"log", "diff", a, directory.file("damaged", damaged_text)});
  CHECK(damaged.code == 3);
  CHECK(contains(damaged.err, "not JSON"));
  const std::string cut_text = text.substr(0, text.rfind("{\"end\""));
  const Outcome cut = call({"log", "diff", a, directory.file("cut", cut_text)});
  CHECK(cut.code == 1);
  CHECK(contains(cut.err, "the recording is cut"));
  CHECK(contains(cut.out, "@@ end @@\n-result success\n"));
  const Outcome from_pipe = run({.arguments = {"log", "diff", a, "-"}, .input = text});
  CHECK(from_pipe.code == 0);
}

// A tree that paces, as its users see it: recordings, measures, events and tables.
#include <catch2/catch.hpp>
#include <set>

#include "support/json.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

// Two motions of 10 s and 5 s at 100 Hz.
std::string record_carry(const TemporaryDirectory& directory, const std::string& pace) {
  const std::string tree = directory.file(
      "tree.xml",
      tree_text("<ParallelRelative name=\"carry\" delta=\"0.1\" pace=\"" + pace +
                "\"><Advance name=\"arm\" step=\"0.001\"/><Advance name=\"base\" step=\"0.002\"/>"
                "</ParallelRelative>"));
  const std::string file = directory.path(pace + ".jsonl");
  const Outcome outcome =
      run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--record", file});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  return file;
}

// A run at 10 Hz on the virtual clock, in the file.
Outcome record_run(const std::string& tree, const std::string& file,
                   const std::vector<std::string>& more = {}) {
  std::vector<std::string> call{"run", tree,     "--clock", "virtual",  "--rate",
                                "10",  "--view", "none",    "--record", file};
  call.insert(call.end(), more.begin(), more.end());
  return run_lockstep(call);
}

double carry_value(const std::string& recording, const std::string& measure) {
  const Outcome outcome =
      run_lockstep({"log", "measure", recording, "--measure", measure, "--json"});
  REQUIRE(outcome.code == 0);
  return parse_json(outcome.out)[0]["value"];
}

}  // namespace

TEST_CASE("a pulse of pauses becomes one slower motion, and takes as long") {
  const TemporaryDirectory directory;
  const std::string held = record_carry(directory, "false"),
                    paced = record_carry(directory, "true");
  CHECK(carry_value(held, "pauses:base") == 399);
  CHECK(carry_value(paced, "pauses:base") == 0);
  CHECK(carry_value(held, "factor:base") == 1);
  CHECK(carry_value(paced, "factor:base") == Approx(0.503).margin(0.001));
  CHECK(carry_value(paced, "factor:arm") == 1);
  CHECK(carry_value(held, "speed-changes:base") == 797);
  CHECK(carry_value(paced, "speed-changes:base") == Approx(0.94).margin(0.01));
  CHECK(carry_value(held, "ticks") == carry_value(paced, "ticks"));
}

TEST_CASE("nodes below a child that is slowed have its factor") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><plugin name="motion"/>
<BehaviorTree ID="M"><ParallelRelative delta="0.1" pace="true"><Sequence memory="true" name="s">
<Inverter><Inverter><Advance name="x" step="0.02"/></Inverter></Inverter></Sequence>
<Advance name="slow" step="0.008"/></ParallelRelative></BehaviorTree></root>)");
  const std::string file = directory.path("r.jsonl");
  REQUIRE(record_run(tree, file).code == 0);
  const double factor = carry_value(file, "factor:s");
  CHECK(factor < 0.9);
  CHECK(carry_value(file, "factor:x") == factor);
  CHECK(carry_value(file, "speed-changes:x") == carry_value(file, "speed-changes:s"));
  std::set<std::string> ends;  // of its rows
  for (const std::string& row : lines(run_lockstep({"log", "csv", file}).out))
    if (contains(row, "/x,running")) ends.insert(row.substr(row.rfind(',') + 1));
  CHECK(ends.size() > 1);
}

TEST_CASE("only recordings of trees that pace have factors") {
  const TemporaryDirectory directory;
  const std::string held = record_carry(directory, "false"),
                    paced = record_carry(directory, "true");
  CHECK_FALSE(contains(read_file(held), "factor"));
  CHECK_FALSE(contains(run_lockstep({"log", "csv", held}).out, "factor"));
  CHECK(contains(run_lockstep({"log", "csv", paced}).out, ",results,factor\n"));
  CHECK(contains(run_lockstep({"log", "csv", paced, "--from", "1", "--to", "1"}).out,
                 "carry/base,running,0.002,1,0,,0.4975\n"));
  CHECK(contains(run_lockstep({"log", "events", paced}).out, "carry/base: 0.497\n"));
  CHECK(contains(run_lockstep({"replay", paced, "--print", "--at", "500"}).out, "0.50"));
  for (const std::string& file : {held, paced}) {
    const std::string image = directory.path(file == held ? "held.svg" : "paced.svg");
    REQUIRE(run_lockstep({"log", "plot", file, "--out", image}).code == 0);
    const std::string data = read_file(std::filesystem::path(image).replace_extension(".dat"));
    CHECK(contains(data, "arm base, the factor of each\n") == (file == paced));
    CHECK(contains(data, " 0.001 0.002 1 0.4975\n") == (file == paced));
  }
}

TEST_CASE("a leaf model is of full speed: verify and `log check` let a slowed leaf take longer") {
  const TemporaryDirectory directory;
  const std::string model = directory.file(
      "model.leaves.xml",
      "<leaves lockstep=\"1\"><leaf of=\"Advance\" result=\"success\" progress=\"grid:10\" "
      "ticks=\"1..10\" finish=\"full\"/><leaf path=\"*/base\" step=\"2..2\"/></leaves>");
  for (const bool paces : {false, true}) {
    const std::string tree = directory.file(
        "tree.xml",
        tree_text("<ParallelRelative delta=\"1\" pace=\"" + std::string(paces ? "true" : "false") +
                  "\" reaction=\"0\"><Advance name=\"arm\" step=\"0.1\"/>"
                  "<Advance name=\"base\" step=\"0.2\"/></ParallelRelative>"));
    const Outcome proof =
        run_lockstep({"verify", tree, "--leaves", model, "--out", directory.path("out"),
                      "--property", "base.running leads to base.done within 5 ticks"});
    INFO(proof.out << proof.err);
    CHECK((proof.code == 0) == !paces);
    CHECK(contains(proof.out, "may take longer than in its leaf model") == paces);
    const std::string recording = directory.path(paces ? "paced.jsonl" : "held.jsonl");
    REQUIRE(record_run(tree, recording).code == 0);
    CHECK(run_lockstep({"log", "check", recording, "--leaves", model, "--tree-file", tree}).code ==
          0);
  }
}

TEST_CASE("check notes a time of a goal that counts in full where its robot is slowed") {
  const TemporaryDirectory directory;
  const auto said = [&](const std::string& attribute) {
    const std::string tree = directory.file(
        "tree.xml", tree_text("<ParallelRelative delta=\"0.1\" pace=\"true\"><Advance/>"
                              "<Action ID=\"BackUp\" " +
                              attribute + "/></ParallelRelative>"));
    return run_lockstep({"check", "--mock", tree}).err;
  };
  const std::string note = "' of 'BackUp' counts in full while 'ParallelRelative' slows";
  CHECK(contains(said("time_allowance=\"10\""), "note: 'time_allowance" + note));
  CHECK(contains(said("goal.time_allowance=\"10\""), "note: 'goal.time_allowance" + note));
  CHECK_FALSE(contains(said("goal.time=\"10\""), note));
}

TEST_CASE("a slowed leaf is on no grid: verify finds what a run does") {
  const TemporaryDirectory directory;
  const std::string model =
      directory.file("model.leaves.xml",
                     "<leaves lockstep=\"1\"><leaf of=\"Advance\" result=\"success\" "
                     "progress=\"grid:4\" step=\"1..2\" finish=\"full\"/></leaves>");
  const std::string property = "never base.progress > 0.25 and base.progress < 0.5";
  for (const bool paces : {false, true}) {
    const std::string tree = directory.file(
        "tree.xml", tree_text("<ParallelAbsolute barriers=\"0.75\" pace=\"" +
                              std::string(paces ? "true" : "false") +
                              "\" reaction=\"0\"><Advance name=\"arm\" step=\"0.25\"/>"
                              "<Advance name=\"base\" step=\"0.5\"/></ParallelAbsolute>"));
    const Outcome proof = run_lockstep(
        {"verify", tree, "--leaves", model, "--property", property, "--out", directory.path("")});
    INFO(proof.out << proof.err);
    CHECK(contains(proof.out, "NO") == paces);
  }
}

TEST_CASE("a slowed leaf with a grid moves no further in a tick than its model says") {
  const TemporaryDirectory directory;
  const std::string model =
      directory.file("model.leaves.xml",
                     "<leaves lockstep=\"1\"><leaf of=\"Advance\" result=\"success\" "
                     "progress=\"grid:10\" step=\"1\" finish=\"full\"/></leaves>");
  for (const auto* const node :
       {"ParallelAbsolute barriers=\"0.55\"", "ParallelRelative delta=\"0.3\""}) {
    const auto tree_with = [&](const std::string& step) {
      const std::string name = fmt::format("{}.xml", step);
      return directory.file(
          name, tree_text(fmt::format("<{} pace=\"true\"><Advance name=\"arm\" step=\"0.1\"/>"
                                      "<Advance name=\"base\" step=\"{}\"/></{}>",
                                      node, step, std::string(node).substr(0, 16))));
    };
    const Outcome proof =
        run_lockstep({"verify", tree_with("0.1"), "--leaves", model, "--out", directory.path("out"),
                      "--property", "never base.progress > 0.75 and arm.progress < 0.45"});
    INFO(node << proof.out << proof.err);
    CHECK(contains(proof.out, "from 10 ticks"));
    CHECK(contains(proof.out, "holds") != contains(node, "Relative"));
    for (const std::string step : {"0.1", "0.4"}) {
      const std::string tree = tree_with(step), recording = directory.path("r.jsonl");
      REQUIRE(record_run(tree, recording).code == 0);
      const Outcome checked =
          run_lockstep({"log", "check", recording, "--leaves", model, "--tree-file", tree});
      INFO(checked.out << checked.err);
      CHECK((checked.code == 0) == (step == "0.1"));
    }
  }
}

// At 0.58 a barrier, at 0.6 and 0.5 a property: none is a part of the grid.
TEST_CASE("a slowed leaf that is between the parts of its grid keeps to its model there too") {
  const TemporaryDirectory directory;
  const std::string model = directory.file(
      "m.leaves.xml",
      "<leaves lockstep=\"1\" rate=\"10\"><leaf path=\"*/a\" result=\"success\" "
      "progress=\"grid:4\" "
      "step=\"1..1\" finish=\"full\"/><leaf path=\"*/b\" result=\"success\" progress=\"grid:10\" "
      "step=\"1..1\" finish=\"full\"/></leaves>");
  for (const auto* const node :
       {"ParallelRelative delta=\"1\"", "ParallelAbsolute barriers=\"0.58\""}) {
    const std::string name = std::string(node).substr(0, 16);
    const std::string tree = directory.file(
        "t.xml",
        tree_text(fmt::format(
            "<{} pace=\"true\"><Advance name=\"a\" step=\"0.25\"/><ForceSuccess><Timeout "
            "seconds=\"0.25\"><Advance name=\"b\" step=\"0.1\"/></Timeout></ForceSuccess></{}>",
            node, name)));
    const std::string property =
        "a.progress >= 0.6 only after a.progress >= 0.5 and a.progress < 0.6";
    const Outcome proof = run_lockstep({"verify", tree, "--leaves", model, "--property", property,
                                        "--only", "property/*", "--out", directory.path("o")});
    INFO(proof.out << proof.err);
    CHECK(contains(proof.out, "NO"));
    const std::string recording = directory.path("r.jsonl");
    const Outcome run =
        record_run(tree, recording, {"--property", property, "--watch-leaves", model});
    INFO(run.out << run.err);
    CHECK(run.code != 5);
    CHECK(run_lockstep({"log", "check", recording, "--leaves", model, "--tree-file", tree}).code ==
          0);
  }
}

TEST_CASE("the scenario of a paced run is that run, also where a slowed Timeout counts") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      tree_text(
          "<ParallelRelative delta=\"0.1\" pace=\"true\"><Advance name=\"slow\" step=\"0.02\"/>"
          "<Timeout seconds=\"3\"><Advance name=\"fast\" step=\"0.05\"/></Timeout>"
          "</ParallelRelative>"));
  const std::string recording = directory.path("r.jsonl"), scenario = directory.path("t.test.xml");
  REQUIRE(record_run(tree, recording).code == 0);
  REQUIRE(run_lockstep({"log", "scenario", recording, "--save", scenario}).code == 0);
  const Outcome outcome = run_lockstep({"test", scenario});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
}

TEST_CASE("log scenario: of a run on the wall clock, a time may take a tick more") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("t.xml", tree_text("<Wait name=\"pause\" seconds=\"0.4\"/>"));
  const std::string recording = directory.path("r.jsonl");
  REQUIRE(record_run(tree, recording).code == 0);
  CHECK(run_lockstep({"log", "scenario", recording}).err.empty());
  std::string text = read_file(recording);
  const std::string clock = "\"clock\":\"virtual\"";
  REQUIRE(contains(text, clock));
  text.replace(text.find(clock), clock.size(), "\"clock\":\"wall\"");
  const std::string wall = directory.file("w.jsonl", text);
  CHECK(contains(run_lockstep({"log", "scenario", wall}).err, "may take a tick more than here"));
}

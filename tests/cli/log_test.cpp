#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;
using nlohmann::json;

namespace {

// A recording of ten ticks.
std::string record(const TemporaryDirectory& directory) {
  const std::string tree = directory.file(
      "tree.xml", tree_text("<ParallelAbsolute name=\"pull\" barriers=\"0.5;1\">"
                            "<Advance name=\"arm\" step=\"0.1\"/>"
                            "<Advance name=\"base\" step=\"0.3\"/></ParallelAbsolute>"));
  const std::string file = directory.path("run.jsonl");
  const Outcome outcome =
      run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--record", file});
  REQUIRE(outcome.code == 0);
  return file;
}

// A closing line of a recording that lacks a tick.
std::string with_loss(std::string closing) {
  return closing.insert(closing.rfind("}}"), ",\"lost\":1");
}

Outcome log(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "log");
  return run_lockstep(std::move(arguments));
}

}  // namespace

TEST_CASE("log csv prints a row for each tick and active node") {
  const TemporaryDirectory directory;
  const Outcome outcome = log({"csv", record(directory)});
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  const auto rows = lines(outcome.out);
  REQUIRE(rows.size() == 1 + 10 * 3);
  CHECK(rows[0] == "tick,time_s,node,path,status,progress,ticked,held,results");
  CHECK(rows[1] == "0,0,0,Main/pull,running,0,1,0,");
  CHECK(rows[9] == "2,0.02,2,Main/pull/base,running,0.6,0,1,");  // the first tick that holds it
}

TEST_CASE("log csv --out writes the same table to a file, but never over the recording") {
  const TemporaryDirectory directory;
  const std::string recording = record(directory);
  const std::string table = directory.path("run.csv");
  const Outcome outcome = log({"csv", recording, "--out", table});
  CHECK(outcome.code == 0);
  CHECK(outcome.out.empty());
  CHECK((read_file(table) == log({"csv", recording}).out));
  const std::string before = read_file(recording);
  CHECK(log({"csv", recording, "--out", recording}).code == 2);
  CHECK((read_file(recording) == before));
  CHECK(log({"csv", recording, "--out", directory.path("none/run.csv")}).code == 2);
  const Outcome full = log({"csv", recording, "--out", "/dev/full"});
  CHECK(full.code == 2);
  CHECK(contains(full.err, "No space left"));
}

TEST_CASE("log info counts one node as one") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text("<AlwaysSuccess/>"));
  const std::string file = directory.path("run.jsonl");
  REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--record", file}).code == 0);
  const Outcome outcome = log({"info", file});
  CHECK(contains(outcome.out, "\n  1 node, 100 Hz"));
  CHECK(contains(outcome.out, "; 0 overruns, 0 deadlines skipped\n"));
}

TEST_CASE("log info sums up") {
  const TemporaryDirectory directory;
  const Outcome outcome = log({"info", record(directory)});
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(contains(outcome.out, "success (completed) after 10 ticks"));
  CHECK(contains(outcome.out, "progress distance 2.1"));
  CHECK(!contains(outcome.out, "\x1b"));
}

TEST_CASE("log info: progress of a member of a pool does not fall where it begins again") {
  const TemporaryDirectory directory;
  const std::string member =
      "<Repeat times=\"2\"><UseResources pool=\"p\" resources=\"a\"><Advance step=\"0.25\"/>"
      "</UseResources></Repeat>";
  const std::string tree =
      directory.file("t.xml",
                     "<root lockstep=\"1\"><plugin name=\"motion\"/><resources name=\"p\"/>"
                     "<BehaviorTree ID=\"M\"><Parallel>" +
                         member + member + "</Parallel></BehaviorTree></root>");
  const std::string recording = directory.path("r.jsonl");
  REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--record", recording}).code == 0);
  const std::string info = run_lockstep({"log", "info", recording}).out;
  CHECK(contains(info, "M/p (resources, 16 ticks)"));
  CHECK_FALSE(contains(info, " fell"));
}

TEST_CASE("log info tells why a run failed, in the words of the run") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml", tree_text("<Sequence name=\"mission\"><Fallback><Inverter><Advance name=\"jam\" "
                            "step=\"0.5\"/></Inverter><AlwaysFailure/></Fallback>"
                            "<ParallelAbsolute barriers=\"0.5\"><Advance/><Advance/>"
                            "</ParallelAbsolute></Sequence>"));
  const std::string file = directory.path("run.jsonl");
  const Outcome run =
      run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--record", file});
  CHECK(run.code == 1);
  const std::string why =
      "  decided by Main/mission/Fallback/AlwaysFailure:\n"
      "    mission (Sequence): failure\n"
      "      Fallback: failure (2 of 2 children)\n"
      "        AlwaysFailure: failure\n"
      "  1 synchronized node was never reached\n";
  CHECK(run.out == "failure after 2 ticks, 0.020 s\n" + why);
  CHECK(log({"info", file}).out.ends_with("\n" + why));
  // Of a recording without its last tick nobody knows.
  const std::string text = read_file(file);
  const auto last = text.find("{\"tick\":1"), end = text.find("{\"end\"");
  const std::string lost =
      directory.file("lost.jsonl", text.substr(0, last) + "{\"lost\":{\"ticks\":1,\"from\":1}}\n" +
                                       with_loss(text.substr(end)));
  CHECK(!contains(log({"info", lost}).out, "decided by"));
}

TEST_CASE("log info prints the tree, as the last tick has left it") {
  const TemporaryDirectory directory;
  const std::string text = read_file(record(directory));
  const std::string tree =
      "    pull (ParallelAbsolute barriers=0.5;1): success\n"
      "      arm (Advance): success\n"
      "      base (Advance): success\n";
  CHECK(contains(log({"info", directory.path("run.jsonl")}).out,
                 "  the tree after tick 9:\n" + tree + "  success (completed) after 10 ticks"));
  const std::string none = directory.file("none.jsonl", text.substr(0, text.find('\n') + 1));
  CHECK(contains(log({"info", none}).out,
                 "  the tree:\n    pull (ParallelAbsolute barriers=0.5;1)\n      arm (Advance)\n"));
}

TEST_CASE("the summary, log info and log measure agree on how long a run took") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text("<Advance step=\"0.125\"/>"));
  const std::string file = directory.path("run.jsonl");
  const auto agree = [&](std::vector<std::string> more, const std::string& ticks) {
    std::vector<std::string> arguments{"run", tree, "--record", file, "--view", "none"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const std::string summary = run_lockstep(arguments).out;
    const auto from = summary.find("after " + ticks + ", ");
    REQUIRE(from != std::string::npos);
    const std::string took = summary.substr(from, summary.find(" s\n") - from);
    CHECK(contains(log({"info", file}).out, took + " s; "));
    const auto measured = parse_json(
        log({"measure", file, "--measure", "duration", "--measure", "ticks", "--json"}).out);
    CHECK(took == fmt::format("after {} ticks, {:.3f}", measured[1]["value"].get<int>(),
                              measured[0]["value"].get<double>()));
    return took;
  };
  CHECK(agree({"--clock", "virtual"}, "8 ticks") == "after 8 ticks, 0.080");
  CHECK(agree({"--clock", "virtual", "--max-ticks", "5"}, "5 ticks") == "after 5 ticks, 0.050");
  agree({"--rate", "1000", "--overrun", "catch-up"}, "8 ticks");
}

TEST_CASE("log: - is stdin") {
  const TemporaryDirectory directory;
  const std::string recording = record(directory);
  for (const std::string command : {"csv", "info"}) {
    const Outcome piped = run({.arguments = {"log", command, "-"}, .input = read_file(recording)});
    CHECK(piped.code == 0);
    CHECK(piped.out == log({command, recording}).out);
  }
}

TEST_CASE("a recording that ends early is read, and that is said") {
  const TemporaryDirectory directory;
  std::string text = read_file(record(directory));
  text.resize(text.size() * 3 / 4);
  const std::string cut = directory.file("cut.jsonl", text);
  for (const std::string command : {"csv", "info"}) {
    const Outcome outcome = log({command, cut});
    CHECK(outcome.code == 0);
    CHECK(!outcome.out.empty());
    CHECK(contains(outcome.err, "the recording is cut"));
  }
  const Outcome scenario = log({"scenario", cut});
  CHECK(scenario.code == 0);
  CHECK(contains(scenario.err, "the recording is cut"));
}

TEST_CASE("a recording with lost ticks is read, and that is said") {
  const TemporaryDirectory directory;
  std::string text = read_file(record(directory));
  const auto begin = text.find("{\"tick\":9"), end = text.find("{\"end\"");
  text =
      text.substr(0, begin) + "{\"lost\":{\"ticks\":1,\"from\":9}}\n" + with_loss(text.substr(end));
  const std::string lossy = directory.file("lossy.jsonl", text);
  for (const std::string command : {"csv", "info", "measure"}) {
    const Outcome outcome = log({command, lossy});
    CHECK(outcome.code == 0);
    CHECK(!outcome.out.empty());
    CHECK(contains(outcome.err, "1 tick is missing, the first is 9: the disk was too slow"));
  }
}

TEST_CASE("what is no recording, or a damaged one, ends with 3") {
  const TemporaryDirectory directory;
  std::string text = read_file(record(directory));
  text.replace(text.find("\"tick\":4"), 8, "\"tick\":x");
  const std::string damaged = directory.file("damaged.jsonl", text);
  const std::string other = directory.file("other.jsonl", "<root/>\n");
  for (const std::string command : {"csv", "info"}) {
    const Outcome outcome = log({command, damaged});
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, "damaged.jsonl:6: "));
    CHECK(log({command, other}).code == 3);
    CHECK(run({.arguments = {"log", command, "-"}}).code == 3);
  }
}

TEST_CASE("what cannot be read, and wrong usage, end with 2") {
  const TemporaryDirectory directory;
  const Outcome missing = log({"csv", directory.path("none.jsonl")});
  CHECK(missing.code == 2);
  CHECK(contains(missing.err, "No such file or directory"));
  CHECK(log({"info", directory.path("")}).code == 2);
  CHECK(run_lockstep({"log"}).code == 2);
  CHECK(log({"csv"}).code == 2);
  CHECK(log({"table", "x.jsonl"}).code == 2);
}

TEST_CASE("a reader that goes away is no error") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("tree.xml", tree_text("<Parallel><Advance step=\"0.0001\"/></Parallel>"));
  const std::string recording = directory.path("run.jsonl");
  REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--record", recording})
              .code == 0);
  for (const std::string before : {"", "trap '' PIPE; "}) {
    const Outcome outcome = run({.arguments = {"-c", before + "\"$0\" log csv \"$1\" | head -n 1",
                                               LOCKSTEP_BINARY_DIR "/lockstep", recording},
                                 .program = "/bin/sh"});
    CHECK(outcome.out == "tick,time_s,node,path,status,progress,ticked,held,results\n");
    CHECK(outcome.err.empty());
  }
}

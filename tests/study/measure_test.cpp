// What a study measures: against traces worked out by hand, and against a single run of the
// program.
#include <catch2/catch.hpp>
#include <map>
#include <regex>

#include "study/study_case.h"
#include "support/json.h"
#include "support/paths.h"

namespace lockstep::host::test {
namespace {

// A synchronized node over two Advance leaves 'a' and 'b'.
std::string pair_of(const std::string& node, const std::string& a, const std::string& b) {
  const std::string tag = node.substr(0, node.find(' '));
  return tree_text("<" + node + " name=\"sync\"><Advance name=\"a\" step=\"" + a +
                   "\"/><Advance name=\"b\" step=\"" + b + "\"/></" + tag + ">");
}

struct Trace {
  std::string name, node, a, b;
  double ticks, distance;
};

// Section and name as in the paper's algorithms, worked by hand.
const std::vector<Trace> kTraces{
    {"A1", "ParallelAbsolute barriers=\"0.5;1\"", "0.1", "0.3", 10, 2.10},
    {"A2", "ParallelAbsolute barriers=\"0.5;1\"", "0.1", "0.25", 10, 1.50},
    {"A3", "ParallelAbsolute barriers=\"0.3\"", "0.2", "0.4", 5, 0.60},
    {"R1", "ParallelRelative delta=\"0.2\"", "0.1", "0.3", 10, 2.30},
    {"R2", "ParallelRelative delta=\"0\"", "0.2", "0.3", 7, 0.60},
    {"R4", "ParallelRelative delta=\"1\"", "0.25", "0.5", 4, 1.00}};

}  // namespace

TEST_CASE("studies: every run without noise has the progress distance worked out by hand") {
  const StudyCase it;
  for (const Trace& trace : kTraces) {
    INFO(trace.name);
    const auto tree = it.file(trace.name + ".xml", pair_of(trace.node, trace.a, trace.b));
    it.make({tree, "--runs", "3"}, trace.name);
    const std::string runs = it.read(trace.name, "runs.csv");
    for (const double ticks : column(runs, "ticks")) CHECK(ticks == trace.ticks);
    for (const double distance : column(runs, "progress-distance Main/sync")) {
      CHECK(distance == Approx(trace.distance).margin(1e-9));
    }
  }
}

TEST_CASE("studies: step length, duration and predictability of a known run") {
  const StudyCase it;
  const auto tree =
      it.file("tree.xml", pair_of("ParallelAbsolute barriers=\"0.5;1\"", "0.1", "0.3"));
  // A1: b stands at 0.6 from tick 2 on, until a has reached the barrier.
  it.make({tree, "--runs", "1", "--rate", "50", "--measure", "step-length", "--measure", "duration",
           "--measure", "predictability:b@0.6", "--measure", "predictability:sync/a@0.4=10",
           "--measure", "predictability:a@1"},
          "out");
  const std::string runs = it.read("out", "runs.csv");
  CHECK(column(runs, "step-length Main/sync").at(0) == Approx(0.3));
  CHECK(column(runs, "duration Main") == std::vector<double>{0.2});
  CHECK(column(runs, "predictability:b@0.6 Main/sync/b") == std::vector<double>{2});
  CHECK(column(runs, "predictability:sync/a@0.4=10 Main/sync/a") == std::vector<double>{-6});
  CHECK(column(runs, "predictability:a@1 Main/sync/a") == std::vector<double>{10});
}

TEST_CASE("studies: how long the members of a pool waited, and how evenly they shared it") {
  const StudyCase it;
  const std::string tree = LOCKSTEP_SOURCE_DIR "/trees/sequel/philosophers.xml";
  it.make({tree, "--runs", "1", "--grid", "increment=0,1", "--max-ticks", "15", "--measure",
           "waits:first", "--measure", "waits:second", "--measure", "waits:table/UseResources#3",
           "--measure", "fairness:forks"},
          "out");
  const std::string runs = it.read("out", "runs.csv");
  const std::string user = " Philosophers/table/UseResources";
  CHECK(column(runs, "waits:first" + user) == std::vector<double>{0, 2});
  CHECK(column(runs, "waits:second" + user + "#2") == std::vector<double>{10, 2});
  CHECK(column(runs, "waits:table/UseResources#3" + user + "#3") == std::vector<double>{15, 2});
  const auto fairness = column(runs, "fairness:forks Philosophers/forks");
  CHECK(fairness.at(0) == Approx(225. / (3 * 125)));
  CHECK(fairness.at(1) == 1);
}

TEST_CASE("studies: names with a colon are in quotes, as a measure and as a column") {
  const StudyCase it;
  const auto tree =
      it.file("tree.xml", tree_text("<ParallelAbsolute barriers=\"0.5;1\" name=\"lift\">"
                                    "<Advance name=\"lift:left\" step=\"0.1\"/>"
                                    "<Advance name=\"lift:right\" step=\"0.3\"/>"
                                    "</ParallelAbsolute>"));
  const std::string by = "held-by:\"lift:right\":\"lift:left\"";
  const Strings study{tree, "--runs", "2", "--measure", by, "--measure", "held:lift:right"};
  it.make(study, "out");
  const std::string runs = it.read("out", "runs.csv");
  const std::string name = "\"held-by:\"\"lift:right\"\":\"\"lift:left\"\" Main/lift/lift:right\"";
  CHECK(column(runs, name) == std::vector<double>{3, 3});
  CHECK(column(runs, "held:lift:right Main/lift/lift:right") == std::vector<double>{3, 3});
  const std::string before = it.bytes("out");
  auto again = study;
  again.emplace_back("--resume");
  it.make(again, "out");
  CHECK(it.bytes("out") == before);
  const Outcome unquoted =
      it.study({tree, "--runs", "1", "--measure", "held-by:lift:right:lift:left"}, "no");
  CHECK(unquoted.code == 2);
  CHECK(contains(unquoted.err, "one that contains ':' is written in quotes"));
}

TEST_CASE("studies: the seed of a run gives the same run to lockstep run, bit for bit") {
  const StudyCase it;
  const std::string tree = kPaper + "example5.xml";
  it.make(
      {tree, "--runs", "5", "--seed", "3", "--grid", "noise=0.01,0.05", "--rate", "30", "--measure",
       "progress-distance", "--measure", "step-length", "--measure", "predictability:a2@0.6"},
      "out");
  for (const std::string& line : lines(it.read("out", "runs.csv"))) {
    if (line.starts_with("cell")) continue;
    const auto row = fields(line);
    const Outcome run = run_lockstep({"run", tree, "--clock", "virtual", "--rate", "30", "--view",
                                      "none", "--json", "--arg", "noise=" + row.at(1), "--seed",
                                      row.at(3), "--record", it.path("run.jsonl")});
    REQUIRE(run.code == 0);
    const auto summary = parse_json(run.out);
    CHECK(summary["ticks"] == std::stoull(row.at(4)));
    const Outcome measured = run_lockstep({"log", "measure", it.path("run.jsonl"), "--json",
                                           "--measure", "progress-distance", "--measure",
                                           "step-length", "--measure", "predictability:a2@0.6"});
    INFO(measured.err);
    REQUIRE(measured.code == 0);
    const auto values = parse_json(measured.out);
    for (std::size_t i = 0; i < 3; ++i) CHECK(values.at(i)["value"] == std::stod(row.at(6 + i)));
  }
}

TEST_CASE("studies: no run sees what the run before it did to its world or its entries") {
  const StudyCase it;
  for (const std::string name : {"paper/experiment1", "paper/experiment3", "fetch_and_carry"}) {
    INFO(name);
    const std::string tree = LOCKSTEP_SOURCE_DIR "/trees/" + name + ".xml";
    const std::string out = name.substr(name.find('/') + 1);
    it.make({tree, "--runs", "6", "--jobs", "1", "--measure", "duration", "--max-ticks", "3000"},
            out);
    const auto rows = lines(it.read(out, "runs.csv"));
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const auto row = fields(rows[i]);  // cell,run,seed,ticks,result,…
      const Outcome run = run_lockstep({"run", tree, "--clock", "virtual", "--view", "none",
                                        "--json", "--max-ticks", "3000", "--seed", row.at(2)});
      const auto summary = parse_json(run.out);
      CHECK(summary["ticks"] == std::stoull(row.at(3)));
      const std::map<std::string, int> codes{{"success", 0}, {"failure", 1}, {"limit", 124}};
      CHECK(run.code == codes.at(row.at(4)));
    }
  }
}

TEST_CASE("studies: the JSON has the intervals of summary.csv") {
  const StudyCase it;
  const Outcome printed = it.study(
      {kPaper + "example5.xml", "--runs", "20", "--json", "--grid", "noise=0.01,0.05"}, "out");
  REQUIRE(printed.code == 0);
  const auto json = parse_json(printed.out);
  const std::string csv = it.read("out", "summary.csv");
  REQUIRE(json.size() == 2);
  for (const std::string name : {"median-low", "median-high", "success-low", "success-high",
                                 "failure-low", "failure-high", "limit-low", "limit-high"}) {
    for (std::size_t row = 0; row < 2; ++row) CHECK(json[row][name] == column(csv, name)[row]);
  }
  CHECK(json[0]["median-low"] < json[0]["median"]);
  CHECK(json[0]["median"] < json[0]["median-high"]);
  CHECK(column(csv, "failure-high")[0] == Approx(0.1684).margin(5e-5));
}

TEST_CASE("studies: a run that does not end counts as limit, a Failure as failure") {
  const StudyCase it;
  const auto endless = it.file("endless.xml", tree_text("<AlwaysRunning/>"));
  it.make({endless, "--runs", "1", "--measure", "duration", "--max-ticks", "20"}, "limit");
  CHECK(contains(it.read("limit", "runs.csv"), ",20,limit,0.2\n"));
  const auto failing = it.file("failing.xml", tree_text("<AlwaysFailure/>"));
  it.make({failing, "--runs", "1", "--measure", "duration"}, "failure");
  CHECK(contains(it.read("failure", "runs.csv"), ",1,failure,0.01\n"));
}

TEST_CASE("studies: cells with other nodes have other columns, the rest is left empty") {
  const StudyCase it;
  const auto tree = it.file(
      "tree.xml",
      "<root lockstep=\"1\" main_tree_to_execute=\"Main\"><arg name=\"how\"/>"
      "<BehaviorTree ID=\"Main\"><SubTree ID=\"${how}\"/></BehaviorTree>"
      "<BehaviorTree ID=\"plain\"><AlwaysSuccess/></BehaviorTree>"
      "<BehaviorTree ID=\"sync\"><ParallelRelative delta=\"0\"><AlwaysSuccess/></ParallelRelative>"
      "</BehaviorTree></root>");
  it.make({tree, "--runs", "1", "--grid", "how=plain,sync"}, "out");
  const auto rows = lines(it.read("out", "runs.csv"));
  CHECK(rows.at(1).ends_with(",1,success,"));
  CHECK(rows.at(2).ends_with(",1,success,0"));
  CHECK(lines(it.read("out", "summary.csv")).size() == 2);
  // The same from its files alone, where nobody knows the trees.
  REQUIRE(it.merge({"out"}, "merged").code == 0);
  CHECK(it.bytes("merged") == it.bytes("out"));
}

TEST_CASE("studies: a node that no tick reached has no measures, and its runs are counted") {
  const StudyCase it;
  const auto tree = it.file(
      "tree.xml", tree_text("<Sequence><AlwaysFailure/><ParallelRelative delta=\"0\" name=\"sync\">"
                            "<Advance name=\"a\"/><Advance/></ParallelRelative></Sequence>"));
  it.make({tree, "--runs", "3", "--measure", "progress-distance", "--measure", "step-length",
           "--measure", "predictability:a@0"},
          "out");
  for (const std::string& line : lines(it.read("out", "runs.csv"))) {
    if (!line.starts_with("cell")) CHECK(line.ends_with(",1,failure,,,,"));
  }
  const auto summary = lines(it.read("out", "summary.csv"));
  REQUIRE(summary.size() == 4);
  CHECK(summary.at(1).starts_with("Main/Sequence/sync,progress-distance,,,,,,,0,3,0,1,0,,,,0,"));
  CHECK(summary.at(2).starts_with("Main/Sequence/sync,step-length,,,,,,,0,3,0,1,0,,,,0,"));
  CHECK(summary.at(3).starts_with("Main/Sequence/sync/a,predictability:a@0,,,,,,,0,3,0,1,0,,,,0,"));
}

TEST_CASE("studies: a run that is cut has not reached what comes later") {
  const StudyCase it;
  const auto tree = it.file("tree.xml", tree_text("<Advance name=\"a\" step=\"0.01\"/>"));
  const Strings study{tree,
                      "--runs",
                      "2",
                      "--max-ticks",
                      "20",
                      "--measure",
                      "predictability:a@0.6",
                      "--measure",
                      "predictability:a@0.1"};
  it.make(study, "out");
  const std::string runs = it.read("out", "runs.csv");
  CHECK(contains(lines(runs).at(1), ",20,limit,,"));
  for (const double gap : column(runs, "gap predictability:a@0.6 Main/a")) {
    CHECK(gap == Approx(0.41));  // before the last tick it was at 0.19
  }
  CHECK(column(runs, "predictability:a@0.1 Main/a") == std::vector<double>{10, 10});
  const Outcome printed = it.study(study, "printed");
  const auto table = lines(std::regex_replace(printed.out, std::regex(" +"), " "));
  REQUIRE(table.size() == 11);
  CHECK(table[0] == "predictability:a@0.6 of Main/a");
  CHECK(table[2] == " - - - - - - - 0 0.41 !");
  CHECK(table[4] == "predictability:a@0.1 of Main/a");
  CHECK(table[6] == " 10 10 10 - 10 10 10 2 0");
  CHECK(table[8] == "results");
  CHECK(table[10] == " 2 0 % [0, 84.2] 0 % [0, 84.2] 100 % [15.8, 100]");
  CHECK(contains(printed.err,
                 "warning: 'predictability:a@0.6' of 'Main/a': in 1 of 1 cells the "
                 "progress did not come near its target"));
}

TEST_CASE("studies: a target that the progress leaps over is far") {
  const StudyCase it;
  const auto tree = it.file("tree.xml", tree_text("<Advance name=\"a\" step=\"1\"/>"));
  auto study = Strings{tree, "--runs", "2", "--measure", "predictability:a@0.6", "--json"};
  const auto json = parse_json(it.study(study, "out").out).at(0);
  CHECK(json["n"] == 2);
  CHECK(json["median"] == 1);
  CHECK(json["gap"] == 0.4);
  CHECK(json["runs"] == 2);
  CHECK(json["success"] == 1.0);
  CHECK(json["failure"] == 0.0);
  CHECK(json["limit"] == 0.0);
}

TEST_CASE("studies: a leaf that fails stops the study at the same run, whatever the threads") {
  const StudyCase it;
  // Only where the arm is slow does the tree get to the leaf that fails.
  const auto tree =
      it.file("tree.xml",
              tree_text("<Fallback><Timeout seconds=\"0.5\"><Advance step=\"0.02\" noise=\"0.02\"/>"
                        "</Timeout><Probe name=\"culprit\"/></Fallback>"));
  const Strings study{tree,
                      "--runs",
                      "500",
                      "--measure",
                      "duration",
                      "--plugin",
                      LOCKSTEP_BINARY_DIR "/tests/abi/plugins/error_in_tick.so"};
  Outcome first;
  for (const std::string jobs : {"1", "2", "5"}) {
    auto arguments = study;
    arguments.insert(arguments.end(), {"--jobs", jobs});
    const Outcome outcome = it.study(arguments, "out" + jobs);
    INFO(outcome.err);
    CHECK(outcome.code == 5);
    CHECK(contains(outcome.err, "lost the arm"));
    if (jobs == "1") first = outcome;
    CHECK(outcome.err == first.err);
    CHECK(it.read("out" + jobs, "runs.csv") == it.read("out1", "runs.csv"));
  }
  // The hint is a command that shows it again.
  const auto at = first.err.find("lockstep run ");
  REQUIRE(at != std::string::npos);
  const std::string command =
      LOCKSTEP_BINARY_DIR "/" + first.err.substr(at, first.err.find('\n', at) - at);
  const Outcome again = run({.arguments = {"-c", command}, .program = "/bin/sh"});
  INFO(command << '\n' << again.err);
  CHECK(again.code == 5);
}

}  // namespace lockstep::host::test

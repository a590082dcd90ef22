// `verify --fmea`: each row was found by hand first.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

// Grasp has two seconds; if it is not done then, the arm retreats.
const std::string kGrasp =
    "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><Sequence memory=\"true\">"
    "<Fallback memory=\"true\"><Timeout seconds=\"2\"><Grasp/></Timeout><Retreat/></Fallback>"
    "<Parallel><Lift/><Watch/></Parallel></Sequence></BehaviorTree></root>\n";

}  // namespace

TEST_CASE("the table of failures says what the tree does when a leaf fails in each way") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("grasp.xml", kGrasp);
  const Outcome outcome = run_lockstep({"verify", tree, "--mock", "--fmea", "--format", "csv"});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  const std::string head = "Leaf,Failure,Tree,Handled by,Halted,Not tried,Property violated\n";
  CHECK(outcome.out.starts_with(head));
  const std::string at = "Main/Sequence/", retreat = at + "Fallback/Retreat",
                    lift = at + "Parallel/Lift", watch = at + "Parallel/Watch",
                    grasp = at + "Fallback/Timeout/Grasp";
  const std::string rows[] = {
      grasp + ",fails at once,success (from 0.1 s)," + at + "Fallback,,,\n",
      grasp + ",never ends,success (from 2.1 s)," + at + "Fallback," + grasp + ",,\n",
      grasp + ",fault,ends with a fault,,," + retreat + "; " + lift + "; " + watch + ",\n",
      grasp + ",5 s late,success (from 2.1 s)," + at + "Fallback," + grasp + ",,\n",
      lift + ",fails at once,failure (from 0.1 s),,",
      lift + ",never ends,may not end,,",
  };
  for (const std::string& row : rows) {
    INFO(row << "\nin\n" << outcome.out);
    CHECK(contains(outcome.out, row));
  }
}

TEST_CASE("the table of failures has properties, and pairs on request") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("grasp.xml", kGrasp);
  const std::vector<std::string> call{
      "verify",   tree,   "--mock",     "--fmea",
      "--format", "json", "--property", "safe: never Retreat.failure"};
  const auto singles = parse_json(run_lockstep(call).out);
  std::size_t violated = 0;
  for (const auto& row : singles) {
    CHECK(row["failures"].size() == 1);
    violated += row["violated"].size();
  }
  CHECK(violated > 0);
  std::vector<std::string> more = call;
  more.emplace_back("--pairs");
  const auto pairs = parse_json(run_lockstep(more).out);
  const std::size_t n = singles.size() / 4;  // of each leaf
  CHECK(pairs.size() == singles.size() + 6 * n * n);
}

TEST_CASE("the table of failures has a property that waits, where the tree waits indefinitely") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "t.xml",
      "<root lockstep=\"1\"><BehaviorTree ID=\"M\"><Sequence memory=\"true\"><A/><B/>"
      "</Sequence></BehaviorTree></root>\n");
  const std::string model = directory.file(
      "t.leaves.xml",
      "<leaves lockstep=\"1\"><leaf path=\"*\" ticks=\"3..5\" result=\"success\"/></leaves>\n");
  std::vector<std::string> call{"verify", tree, "--mock", "--leaves", model, "--fmea"};
  for (const std::string property :
       {"p: sometimes B.ticked", "q: A.running leads to A.done", "r: A.running until B.running"})
    call.insert(call.end(), {"--property", property});
  const Outcome whole = run_lockstep(call);
  CHECK(whole.code == 0);
  CHECK(contains(whole.out,
                 "| M/Sequence/A | never ends | may not end |  |  | M/Sequence/B | p; q; r |"));
  // What a search with a limit has not seen is no fact.
  call.insert(call.end(), {"--states", "12"});
  const Outcome limited = run_lockstep(call);
  CHECK(limited.code == 124);
  CHECK(contains(limited.out, "| 5 s late | more may happen: the search had a limit |  |  |  |"));
}

TEST_CASE("a table of failures has its own formats") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("grasp.xml", kGrasp);
  CHECK(run_lockstep({"verify", tree, "--mock", "--format", "csv"}).code == 2);
  CHECK(run_lockstep({"verify", tree, "--mock", "--fmea", "--format", "junit"}).code == 2);
  for (const char* const other : {"--save=s.test.xml", "--only=results"})
    CHECK(run_lockstep({"verify", tree, "--mock", "--fmea", other}).code == 2);
  CHECK(run_lockstep({"verify", tree, "--mock", "--pairs"}).code == 2);
  const std::string table = run_lockstep({"verify", tree, "--mock", "--fmea"}).out;
  CHECK(table.starts_with("| Leaf | Failure | Tree |"));
}

namespace {

// The rows of a leaf model in which one leaf fails in this way, and all others succeed.
std::string model_of_failure(const std::string& leaf, const std::string& failure,
                             const std::string& others) {
  const std::map<std::string, std::string> words{
      {"fails at once", R"(result="failure" ticks="1")"},
      {"fails late", R"(result="failure" ticks="10")"},
      {"never ends", R"(result="success" ticks="1000000")"},
      {"fault", R"(result="fault" ticks="1")"},
      {"5 s late", R"(result="success" ticks="51")"},
      {"no progress", R"(result="success" step="0..0")"}};
  return "<leaves lockstep=\"1\" rate=\"10\"><leaf path=\"*\" result=\"success\"" + others +
         "/><leaf path=\"" + leaf + "\" " + words.at(failure) + "/></leaves>";
}

// What the runs of a row show.
struct SeenRow {
  std::map<std::string, int> results = {};  // with the fewest ticks of each
  bool fault = false, may_not_end = false;
  std::set<std::string> halted = {}, started = {};

  void add(const Outcome& outcome, const std::string& events) {
    const auto summary = parse_json(outcome.out);
    const std::string result = summary["result"];
    const int ticks = summary["ticks"];
    fault |= outcome.code == 5;
    may_not_end |= outcome.code == 124;
    if (outcome.code <= 1) {
      const auto it = results.try_emplace(result, ticks).first;
      it->second = std::min(it->second, ticks);
    }
    // "     2.800 s  tick 28       halt     OpenDoor/open/pull/base"
    std::istringstream lines(events);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string time, unit, tick, number, what, path;
      words >> time >> unit >> tick >> number >> what >> path;
      if (what == "fault") path.pop_back();  // "PATH: message"
      started.insert(path);
      if (what == "halt" && outcome.code <= 1) halted.insert(path);
    }
  }
};

}  // namespace

TEST_CASE("each row of the door's table of failures is what runs with that failure do") {
  const TemporaryDirectory directory;
  const std::string tree = LOCKSTEP_SOURCE_DIR "/trees/door_pulling.xml";
  const auto table = parse_json(run_lockstep({"verify", tree, "--fmea", "--format", "json"}).out);
  CHECK(table.size() == 27);
  const std::string record = directory.path("run.jsonl");
  std::set<std::string> all;
  for (const auto& row : table) all.insert(row["failures"][0]["leaf"].get<std::string>());
  // The others are as fast as they can be, or slow, or anything.
  for (const auto& row : table) {
    const std::string leaf = row["failures"][0]["leaf"], failure = row["failures"][0]["failure"];
    SeenRow seen;
    for (int seed = 0; seed < 9; ++seed) {
      const std::string model =
          directory.file("door.leaves.xml", model_of_failure(leaf, failure,
                                                             seed == 0   ? " ticks=\"1\""
                                                             : seed == 1 ? " ticks=\"15..inf\""
                                                                         : ""));
      const Outcome run = run_lockstep({"run", tree, "--leaves", model, "--clock", "virtual",
                                        "--seed", std::to_string(seed), "--max-ticks", "300",
                                        "--view", "none", "--json", "--record", record});
      seen.add(run, run_lockstep({"log", "events", record}).out);
    }
    INFO(leaf << " " << failure << "\n" << row.dump());
    std::map<std::string, int> results;
    for (const auto& [result, seconds] : row["results"].items())
      results[result] = static_cast<int>(std::lround(seconds.get<double>() * 10));
    CHECK(seen.results == results);
    CHECK(seen.fault == row["fault"].get<bool>());
    CHECK(seen.may_not_end == row["may_not_end"].get<bool>());
    // A recording has no line for the halts at the end that a fault is.
    if (!seen.fault) CHECK(seen.halted == row["halted"].get<std::set<std::string>>());
    std::set<std::string> not_tried;
    std::ranges::set_difference(all, seen.started, std::inserter(not_tried, not_tried.end()));
    CHECK(not_tried == row["not_tried"].get<std::set<std::string>>());
    CHECK(row["handled_by"].is_null());  // no run with a failure succeeds
    CHECK(row["violated"].empty());
  }
}

TEST_CASE("the table of failures has each leaf that is halted, also late and at the end of a run") {
  const TemporaryDirectory directory;
  const auto halted = [&](const std::string& nodes, const std::string& leaf,
                          const std::string& failure) {
    const std::string tree =
        directory.file("tree.xml", "<root lockstep=\"1\"><BehaviorTree ID=\"T\">" + nodes +
                                       "</BehaviorTree></root>");
    const Outcome outcome = run_lockstep({"verify", tree, "--mock", "--fmea", "--format", "json"});
    for (const auto& row : parse_json(outcome.out)) {
      const auto& it = row["failures"][0];
      if (it["leaf"] == leaf && it["failure"] == failure) return row["halted"].dump();
    }
    return outcome.err;
  };
  CHECK(halted("<Timeout seconds=\"11000\"><A/></Timeout>", "T/Timeout/A", "never ends") ==
        R"(["T/Timeout/A"])");
  CHECK(halted("<Parallel><A name=\"a\"/><A name=\"b\"/></Parallel>", "T/Parallel/b", "fault") ==
        R"(["T/Parallel/a"])");
}

TEST_CASE("the time of a table of failures is for all of its rows, and what is short has its row") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", R"(<root lockstep="1"><BehaviorTree ID="T">
<Timeout seconds="1000000"><Parallel><A name="a"/><A name="b"/></Parallel></Timeout></BehaviorTree></root>)");
  const Outcome outcome =
      run_lockstep({"verify", tree, "--mock", "--fmea", "--format", "json", "--time", "2"});
  CHECK(outcome.code == 124);
  CHECK(outcome.cpu_seconds < 3);
  const auto rows = parse_json(outcome.out);
  REQUIRE(rows.size() == 10);
  for (const auto& row : rows) {
    const std::string how = row["failures"][0]["failure"];
    if (how == "fails at once" || how == "fault") CHECK(row["complete"].get<bool>());
    if (how == "never ends") CHECK_FALSE(row["complete"].get<bool>());
  }
}

TEST_CASE("the time of a table of failures ends in the middle of a tick of many rounds") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("tree.xml", R"(<root BTCPP_format="4"><BehaviorTree ID="T"><Sequence>
<Script code="n := 0"/><RetryUntilSuccessful num_attempts="-1"><Sequence><A/><B/><Script code="n += 1"/>
<AlwaysFailure/></Sequence></RetryUntilSuccessful></Sequence></BehaviorTree></root>)");
  const Outcome outcome = run_lockstep({"verify", tree, "--mock", "--fmea", "--format", "json",
                                        "--time", "0.5", "--property", "never {n} < 0"});
  CHECK(outcome.code == 124);
  CHECK(outcome.cpu_seconds < 3);
}

// A tick in which nodes are begun again: each output reports what happened in it, as for a tree in
// lockstep's own language, which has a tick for each round.
#include <catch2/catch.hpp>
#include <fstream>

#include "support/json.h"
#include "support/program.h"

using namespace lockstep::host::test;
using nlohmann::json;

namespace {

// Of 3 attempts 2 fail. `reach` takes 3 ticks.
const char* const kRetry =
    R"(<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main"><Sequence>
    <Script code="n := 0"/>
    <RetryUntilSuccessful name="retry" num_attempts="3"><Sequence name="try">
      <Sleep name="reach" msec="300" _onSuccess="n := n + 1"/>
      <ScriptCondition name="grasped" code="n &gt;= 3"/>
    </Sequence></RetryUntilSuccessful></Sequence></BehaviorTree></root>)";

// All rounds in one tick.
std::string rounds(const std::string& times, const std::string& fails_before) {
  return R"(<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main"><Sequence>
    <Script code="n := 0"/>
    <RetryUntilSuccessful name="retry" num_attempts=")" +
         times + R"("><Sequence name="try">
      <Script name="count" code="n := n + 1"/>
      <ScriptCondition name="grasped" code="n &gt; )" +
         fails_before + R"("/>
    </Sequence></RetryUntilSuccessful></Sequence></BehaviorTree></root>)";
}

struct Recorded {
  TemporaryDirectory directory;
  std::string tree, recording;
  Outcome run;

  explicit Recorded(const std::string& text, std::vector<std::string> more = {})
      : tree(directory.file("tree.xml", text)), recording(directory.path("run.jsonl")) {
    more.insert(more.begin(), {"run", tree, "--clock", "virtual", "--rate", "10", "--view", "none",
                               "--record", recording});
    run = run_lockstep(more);
  }
  Outcome log(std::vector<std::string> words) const {
    words.insert(words.begin() + 1, recording);
    words.insert(words.begin(), "log");
    return run_lockstep(words);
  }
  std::string events(std::vector<std::string> more) const {
    more.insert(more.begin(), {"events", "--format", "csv"});
    return log(more).out;
  }
};

}  // namespace

TEST_CASE("moments: the rounds of a Retry are events, in their order") {
  const Recorded it(kRetry);
  CHECK(it.run.code == 0);
  CHECK(it.events({"--path", "*/reach"}) ==
        "tick,time_s,event,what,value\n"
        "0,0,start,Main/Sequence/retry/try/reach,\n"
        "3,0.3,success,Main/Sequence/retry/try/reach,\n"
        "3,0.3,start,Main/Sequence/retry/try/reach,\n"
        "6,0.6,success,Main/Sequence/retry/try/reach,\n"
        "6,0.6,start,Main/Sequence/retry/try/reach,\n"
        "9,0.9,success,Main/Sequence/retry/try/reach,\n");
  CHECK(it.events({"--path", "*/grasped"}) ==
        "tick,time_s,event,what,value\n"
        "3,0.3,failure,Main/Sequence/retry/try/grasped,\n"
        "6,0.6,failure,Main/Sequence/retry/try/grasped,\n"
        "9,0.9,success,Main/Sequence/retry/try/grasped,\n");
}

TEST_CASE("moments: a table has a row for each tick and node, with the results within the tick") {
  const Recorded it(kRetry);
  std::vector<std::string> grasped, reach;
  for (const std::string& row : lines(it.log({"csv"}).out)) {
    if (contains(row, "/grasped,")) grasped.push_back(row);
    if (contains(row, "/reach,")) reach.push_back(row);
  }
  CHECK(grasped ==
        std::vector<std::string>{"3,0.3,5,Main/Sequence/retry/try/grasped,idle,0,1,0,failure",
                                 "6,0.6,5,Main/Sequence/retry/try/grasped,idle,0,1,0,failure",
                                 "9,0.9,5,Main/Sequence/retry/try/grasped,success,0,1,0,"});
  REQUIRE(reach.size() == 10);
  CHECK(reach[3] == "3,0.3,4,Main/Sequence/retry/try/reach,running,1,1,0,success");
  CHECK(reach[4].ends_with(",1,0,"));
  const Recorded many(rounds("1000", "999"));
  CHECK(contains(many.log({"csv"}).out, "\"999 times failure, success\"\n"));
}

TEST_CASE("moments: a replay in the terminal shows the results within a tick") {
  const Recorded it(kRetry);
  const auto printed = [&](const std::string& tick) {
    return run_lockstep({"replay", it.recording, "--print", "--at", tick}).out;
  };
  CHECK(contains(printed("3"), "within this tick: Main/Sequence/retry/try/reach: success\n"));
  CHECK(contains(printed("3"), "within this tick: Main/Sequence/retry/try/grasped: failure\n"));
  CHECK_FALSE(contains(printed("2"), "within this tick"));
}

TEST_CASE("moments: a property sees each of them, in a run and in its recording") {
  const std::vector<std::string> properties = {
      "never grasped.failure",
      "grasped.success only after grasped.failure",
      "grasped.failure only after grasped.success",
      "never reach.success and grasped.failure",
      "never reach.running and grasped.failure",
      "reach.success at most 1 ticks",
      "grasped.failure leads to grasped.success within 6 ticks",
      "grasped.failure leads to grasped.success within 5 ticks"};
  std::vector<std::string> options;
  for (const auto& each : properties) options.insert(options.end(), {"--property", each});
  options.emplace_back("--json");
  const Recorded it(kRetry, options);
  json live = json::array(), recorded = json::array();
  const json summary = json::parse(it.run.out);
  for (const json& each : summary.at("properties")) {
    live.push_back({each.at("verdict"), each.at("tick")});
  }
  options.insert(options.begin(), "check");
  for (const json& each : json::parse(it.log(options).out)) {
    recorded.push_back({each.at("verdict"), each.at("tick")});
  }
  CHECK(live == json::parse(R"([["violated", 3], ["holds", 3], ["violated", 3], ["violated", 3],
                                ["holds", null], ["holds", null], ["holds", null],
                                ["violated", 8]])"));
  CHECK(recorded == live);
}

// `fast` is ahead of `slow` and held in tick 1. In tick 2 `slow` comes first and completes, with a
// Fallback in it that is halted.
TEST_CASE("moments: a node is held in those of a tick that withholds its ticks, and in no others") {
  const auto run = [](const std::string& slow, const std::string& leaves) {
    const TemporaryDirectory directory;
    const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><plugin name="motion"/>
<BehaviorTree ID="T"><ParallelRelative name="p" success_count="1" delta="0.1">)" +
                                                         slow + R"(<Advance name="fast"/>
</ParallelRelative></BehaviorTree></root>)");
    const std::string recording = directory.path("run.jsonl");
    const Outcome it = run_lockstep(
        {"run", tree, "--clock", "virtual", "--rate", "10", "--view", "none", "--record", recording,
         "--leaves", directory.file("t.leaves", "@rate 10\n" + leaves), "--property",
         "never fast.held", "--property", "fast.held at most 1 ticks", "--json"});
    INFO(it.out << it.err);
    const json summary = json::parse(it.out);
    std::vector<json> all;
    for (const json& each : summary.at("properties")) all.push_back(each.at("tick"));
    const Outcome held = run_lockstep({"log", "measure", recording, "--measure", "held:fast"});
    return std::pair(all, held.out.substr(held.out.rfind(' ') + 1));
  };
  const auto [resumed, one] = run(
      R"(<Parallel name="slow" success_count="1"><Wait seconds="0.2"/>
<Fallback memory="true"><Advance name="a"/><Advance name="b"/></Fallback></Parallel>)",
      "T/p/slow/Fallback/a = R0.5 R0.95 F\nT/p/slow/Fallback/b = R\nT/p/fast = R0.95\n");
  CHECK(resumed == std::vector<json>{1, nullptr});
  CHECK(one == "1\n");
  // Also in the tick in which the node ends that holds it.
  const auto [ended, two] =
      run(R"(<Advance name="slow"/>)", "T/p/slow = R0.1 R0.2 S\nT/p/fast = R0.9\n");
  CHECK(ended == std::vector<json>{1, 2});
  CHECK(two == "2\n");
}

TEST_CASE("moments: a recording has those of a tick that has several, and of no other") {
  const Recorded it(kRetry);
  std::size_t lines = 0;
  std::ifstream file(it.recording);
  for (std::string text; std::getline(file, text);) {
    const json line = json::parse(text);
    if (!line.contains("moments")) continue;
    ++lines;
    CHECK((line["tick"] == 3 || line["tick"] == 6));
    CHECK(line["moments"].size() == 2);
  }
  CHECK(lines == 2);
}

TEST_CASE("moments: equal rounds of a tick are counted") {
  const Recorded it(rounds("100", "7"));
  CHECK(it.run.code == 0);
  CHECK(it.events({"--path", "*/grasped"}) ==
        "tick,time_s,event,what,value\n"
        "0,0,failure,Main/Sequence/retry/try/grasped,\n"
        "0,0,failure,Main/Sequence/retry/try/grasped,6 times\n"
        "0,0,success,Main/Sequence/retry/try/grasped,\n");
}

TEST_CASE("moments: the lines of a run tell that a leaf succeeded before it was reset") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      R"(<root lockstep="1"><BehaviorTree ID="T"><Parallel><KeepRunningUntilFailure><A name="a"/>
      </KeepRunningUntilFailure><A name="b"/></Parallel></BehaviorTree></root>)");
  const std::string leaves = directory.file(
      "run.leaves", "@rate 10\nT/Parallel/KeepRunningUntilFailure/a = R S\nT/Parallel/b = R F\n");
  const Outcome run = run_lockstep(
      {"run", tree, "--mock", "--leaves", leaves, "--clock", "virtual", "--view", "plain"});
  CHECK(contains(run.err + run.out, "T/Parallel/KeepRunningUntilFailure/a: success\n"));
  CHECK(!contains(run.err + run.out, "a: halted"));
}

TEST_CASE(
    "moments: log measure leaves out the children that the last decision of a tick left out") {
  // `a` is skipped in a round that ends within a tick, and then runs; or runs not yet.
  const std::string skipped_before =
      R"(<AsyncSequence name="a" _skipIf="n == 0"><AlwaysSuccess/><Advance step="0.04"/></AsyncSequence>
      <Advance name="b" step="0.02" _onSuccess="n += 1"/>)";
  const std::string still_skipped =
      R"(<Advance name="a" step="0.3" _skipIf="n &lt; 2"/>
      <AsyncSequence name="b" _onSuccess="n += 1"><AlwaysSuccess/><Advance step="0.5"/></AsyncSequence>)";
  for (const std::string& children : {skipped_before, still_skipped}) {
    const TemporaryDirectory directory;
    const std::string tree = directory.file(
        "tree.xml",
        R"(<root BTCPP_format="4"><BehaviorTree ID="T"><Sequence><Script code="n := 0"/>
        <Repeat num_cycles="3"><ParallelRelative name="p" delta="1">)" +
            children + "</ParallelRelative></Repeat></Sequence></BehaviorTree></root>");
    const std::string file = directory.path("run.jsonl");
    const Outcome run = run_lockstep(
        {"run", tree, "--plugin", "motion", "--clock", "virtual", "--json", "--record", file});
    REQUIRE(run.code == 0);
    const json node = json::parse(run.out)["synchronized_nodes"][0];
    const Outcome measured = run_lockstep({"log", "measure", file, "--measure", "progress-distance",
                                           "--measure", "spread", "--json"});
    INFO(run.out << measured.out << measured.err);
    const json rows = json::parse(measured.out);
    CHECK(rows.dump().find(node["progress_distance"].dump()) != std::string::npos);
    CHECK(rows.dump().find(node["largest_spread"].dump()) != std::string::npos);
  }
}

TEST_CASE("moments: what has no room is counted without its order") {
  // Each round of the outer node has another number of attempts, so no two moments are equal.
  const Recorded it(R"(<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main">
    <Sequence><Script code="n := 0; odd := false"/>
    <Repeat num_cycles="600"><Sequence><Script code="n := n + 1; odd := !odd"/>
      <ForceSuccess><ScriptCondition name="even" code="!odd"/></ForceSuccess>
    </Sequence></Repeat></Sequence></BehaviorTree></root>)",
                    {"--property", "never even.failure", "--property", "sometimes even.success"});
  const auto events = it.events({"--path", "*/even"});
  std::uint64_t failures = 0, successes = 0;
  std::size_t lines = 0;
  for (std::size_t at = events.find('\n') + 1; at < events.size();) {
    const std::size_t end = events.find('\n', at);
    const std::string line = events.substr(at, end - at);
    const std::string value = line.substr(line.rfind(',') + 1);
    const std::uint64_t times = value.empty() ? 1 : std::stoull(value);
    (line.find(",failure,") != std::string::npos ? failures : successes) += times;
    ++lines;
    at = end + 1;
  }
  CHECK(failures == 300);
  CHECK(successes == 300);
  CHECK(lines < 300);
  CHECK(contains(it.log({"scenario"}).err, "more moments than a recording keeps"));
  const Outcome check =
      it.log({"check", "--property", "never even.failure", "--property", "sometimes even.success"});
  CHECK(check.out.find("violated  0") != std::string::npos);
}

namespace {

// The leaf is one of a plugin, so a scenario has its words.
const char* const kAdvance =
    R"(<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main"><Sequence>
    <Script code="n := 0"/>
    <RetryUntilSuccessful name="retry" num_attempts="3"><Sequence name="try">
      <Action ID="Advance" name="reach" step="0.5" _onSuccess="n := n + 1"/>
      <ScriptCondition name="grasped" code="n &gt;= 3"/>
    </Sequence></RetryUntilSuccessful></Sequence></BehaviorTree></root>)";

Outcome test(const Recorded& it, const std::string& scenario, std::vector<std::string> more = {}) {
  const std::string file = it.directory.file(
      "t.test.xml", "<scenarios lockstep=\"1\" tree=\"tree.xml\">" + scenario + "</scenarios>");
  more.insert(more.begin(), {"test", file, "--plugin", "motion"});
  return run_lockstep(more);
}

}  // namespace

TEST_CASE("moments: a recorded scenario has a word of a leaf for each of its ticks") {
  const Recorded it(kAdvance, {"--plugin", "motion"});
  CHECK(it.run.code == 0);
  const Outcome scenario = it.log({"scenario", it.tree, "--plugin", "motion"});
  CHECK(scenario.err == "");
  CHECK(scenario.out.find("does=\"R0.5 S R0.5 S R0.5 S\"") != std::string::npos);
}

TEST_CASE("moments: scenarios and coverage see them") {
  const Recorded it(kAdvance, {"--plugin", "motion"});
  const std::string leaf =
      "<leaf path=\"Main/Sequence/retry/try/reach\" does=\"R0.5 S R0.5 S R0.5 S\"/>";
  const Outcome fails = test(it, "<scenario name=\"a\" rate=\"10\">" + leaf +
                                     "<expect>never grasped.failure</expect></scenario>");
  CHECK(fails.code == 1);
  CHECK(fails.out.find("'never grasped.failure' is violated in tick 1") != std::string::npos);
  CHECK(fails.out.find("Main/Sequence/retry/try/grasped: failure") != std::string::npos);
  const Outcome covers = test(it,
                              "<scenario name=\"a\" rate=\"10\">" + leaf +
                                  "<expect result=\"success\" ticks=\"4\"/></scenario>",
                              {"--coverage"});
  CHECK(covers.code == 0);
  CHECK(covers.out.find("Main/Sequence/retry/try/grasped  +       +        +") !=
        std::string::npos);
}

TEST_CASE("moments: verify proves nothing of the last round only, and plays what it found") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("tree.xml",
                     R"(<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main">
      <RetryUntilSuccessful name="retry" num_attempts="-1"><Sequence name="try">
        <Action ID="Reach"/><Condition ID="Grasped"/>
      </Sequence></RetryUntilSuccessful></BehaviorTree></root>)");
  const std::string leaves =
      directory.file("leaves.xml",
                     "<leaves lockstep=\"1\" rate=\"10\"><leaf of=\"Reach\" result=\"success\" "
                     "ticks=\"2..3\"/></leaves>");
  const Outcome it = run_lockstep({"verify", tree, "--mock", "--leaves", leaves, "--property",
                                   "never Grasped.failure", "--out", directory.path("out")});
  CHECK(it.out.find("property 'never Grasped.failure'  NO") != std::string::npos);
  const std::size_t fails = it.out.find("never fails");
  CHECK(it.out.substr(fails, it.out.find('\n', fails) - fails).find("Grasped") ==
        std::string::npos);
  CHECK(it.out.find("Reach is halted") == std::string::npos);
  CHECK(it.out.find("Reach succeeded, Main/retry/try/Grasped failed") != std::string::npos);
  // The script makes the run that was found.
  const Outcome check = run_lockstep({"log", "check", directory.path("out/tree.cycle.jsonl"),
                                      "--property", "never Grasped.failure"});
  CHECK(check.out.find("violated") != std::string::npos);
}

TEST_CASE("moments: a handler that succeeds while it is halted is told of, and not as halted") {
  // The tree times out in the first child, so the last one is ticked once, in the halt.
  const Recorded it(
      R"(<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main">
      <Timeout msec="250"><TryCatch name="try" catch_on_halt="true">
        <Sleep name="work" msec="1000"/><AlwaysSuccess name="handler"/>
      </TryCatch></Timeout></BehaviorTree></root>)");
  CHECK(it.events({"--path", "*/handler"}) ==
        "tick,time_s,event,what,value\n"
        "3,0.3,success,Main/Timeout/try/handler,\n");
}

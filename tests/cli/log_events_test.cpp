// `lockstep log events`: what happened in a run, a line each.
#include <catch2/catch.hpp>
#include <set>

#include "record/use/recording_events.h"
#include "support/paths.h"
#include "support/program.h"

namespace lockstep::host::test {
namespace {

// `base` reaches the barrier first, is held for a tick, and completes first.
constexpr const char* kLogEventsTree =
    "<root lockstep=\"1\"><plugin name=\"motion\"/><BehaviorTree ID=\"Test\">"
    "<Sequence on_success=\"done := 'yes, &quot;it&quot; is'\">"
    "<ParallelAbsolute name=\"pull\" barriers=\"0.5;1\"><Advance name=\"arm\" step=\"0.25\"/>"
    "<Advance name=\"base\" step=\"0.5\"/></ParallelAbsolute></Sequence></BehaviorTree></root>";

std::string events(const TemporaryDirectory& directory, std::vector<std::string> more = {}) {
  const std::string file = directory.path("run.jsonl.zst");
  const std::string tree = directory.file("tree.xml", kLogEventsTree);
  REQUIRE(
      run_lockstep({"run", tree, "--clock", "virtual", "--rate", "10", "--record", file}).code ==
      0);
  more.insert(more.begin(), {"log", "events", file});
  const Outcome outcome = run_lockstep(more);
  CHECK(outcome.err == "");
  CHECK(outcome.code == 0);
  return outcome.out;
}

}  // namespace

TEST_CASE("log events: starts, results, holds, entries and the end, in order") {
  const TemporaryDirectory directory;
  CHECK(events(directory, {"--format", "csv"}) ==
        "tick,time_s,event,what,value\n"
        "0,0,start,Test/Sequence,\n"
        "0,0,start,Test/Sequence/pull,\n"
        "0,0,start,Test/Sequence/pull/arm,\n"
        "0,0,start,Test/Sequence/pull/base,\n"
        "1,0.1,hold,Test/Sequence/pull/base,\n"
        "2,0.2,release,Test/Sequence/pull/base,\n"
        "2,0.2,success,Test/Sequence/pull/base,\n"
        "3,0.3,success,Test/Sequence,\n"
        "3,0.3,success,Test/Sequence/pull,\n"
        "3,0.3,success,Test/Sequence/pull/arm,\n"
        "3,0.3,entry,done,\"yes, \"\"it\"\" is\"\n"
        "4,0.4,end,,success (completed)\n");
}

TEST_CASE("log events: chosen by path, event and ticks, as text and JSON") {
  const TemporaryDirectory directory;
  CHECK(events(directory, {"--path", "base", "--event", "hold", "--event", "release"}) ==
        "     0.100 s  tick 1        hold     Test/Sequence/pull/base\n"
        "     0.200 s  tick 2        release  Test/Sequence/pull/base\n");
  CHECK(events(directory, {"--path", "*/b*", "--from", "2", "--to", "2", "--format", "json"}) ==
        "{\"tick\":2,\"time_s\":0.2,\"event\":\"release\",\"what\":\"Test/Sequence/pull/base\","
        "\"value\":\"\"}\n"
        "{\"tick\":2,\"time_s\":0.2,\"event\":\"success\",\"what\":\"Test/Sequence/pull/base\","
        "\"value\":\"\"}\n");
  CHECK(events(directory, {"--path", "done", "--to", "2"}) == "");
  const std::string file = directory.path("run.jsonl.zst");
  const Outcome typo = run_lockstep({"log", "events", file, "--path", "arm", "--path", "bse"});
  CHECK(typo.code == 2);
  CHECK(contains(typo.out, "start    Test/Sequence/pull/arm"));
  CHECK(contains(typo.err, "--path bse: no node, entry or leaf that logs is called so"));
}

// `count` succeeds in the ticks 0, 2 and 4; in between it is not reached, and stays as it is.
// `ready` succeeds in each tick.
TEST_CASE("log events: a node that completes anew has an event, also with the same result") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      "<root lockstep=\"1\"><plugin name=\"motion\"/><BehaviorTree ID=\"Test\"><Repeat times=\"3\">"
      "<Sequence memory=\"true\"><Script name=\"count\" code=\"n := 1\"/>"
      "<Sequence><Check name=\"ready\" code=\"n == 1\"/><Advance name=\"move\" step=\"0.9\"/>"
      "</Sequence></Sequence></Repeat></BehaviorTree></root>");
  const std::string file = directory.path("run.jsonl");
  REQUIRE(
      run_lockstep({"run", tree, "--clock", "virtual", "--rate", "10", "--record", file}).code ==
      0);
  CHECK(
      run_lockstep({"log", "events", file, "--path", "count", "--path", "ready", "--format", "csv"})
          .out ==
      "tick,time_s,event,what,value\n"
      "0,0,success,Test/Repeat/Sequence/count,\n"
      "0,0,success,Test/Repeat/Sequence/Sequence/ready,\n"
      "2,0.2,success,Test/Repeat/Sequence/count,\n"
      "4,0.4,success,Test/Repeat/Sequence/count,\n");
}

// `q` holds `s` in the ticks 1, 2 and 4; in tick 2 `q` is held itself. `a` is below `s`.
TEST_CASE("log events: each hold has its release, also where the node above is held in between") {
  std::string text =
      R"({"lockstep_recording":1,"tree":"T","file":"t.xml","version":"1","law":3,"rate_hz":10,)"
      R"("clock":"virtual","seed":0,"arguments":{},"nodes":[)";
  const char* const paths[] = {"T/p", "T/p/q", "T/p/q/s", "T/p/q/s/a"};
  for (int node = 0; node < 4; ++node) {
    const std::string path = paths[node];
    text += (node > 0 ? ",{\"index\":" : "{\"index\":") + std::to_string(node) + ",\"path\":\"" +
            path + "\",\"name\":\"" + path.substr(path.rfind('/') + 1) +
            "\",\"parent\":" + (node > 0 ? std::to_string(node - 1) : "null") +
            (node < 2   ? ",\"kind\":\"ParallelAbsolute\",\"barriers\":[0.5]}"
             : node < 3 ? ",\"kind\":\"Sequence\"}"
                        : ",\"kind\":\"Advance\"}");
  }
  text += "]}\n";
  const char* const states[] = {
      R"([0,"running",0,1,0],[1,"running",0,1,0],[2,"running",0,1,0],[3,"running",0,1,0])",
      R"([2,"running",0,0,1],[3,"running",0,0,1])",
      R"([0,"running",0,1,0],[1,"running",0,0,1],[2,"running",0,0,1],[3,"running",0,0,1])",
      R"([1,"running",0,1,0],[2,"running",0,1,0],[3,"running",0,1,0])",
      R"([2,"running",0,0,1],[3,"running",0,0,1])",
      R"([2,"running",0,1,0],[3,"running",0,1,0])"};
  for (int tick = 0; tick < 6; ++tick) {
    text += "{\"tick\":" + std::to_string(tick) + ",\"time_s\":0." + std::to_string(tick) +
            ",\"nodes\":[" + states[tick] + (tick == 2 ? "],\"whole\":[]}\n" : "]}\n");
  }
  const TemporaryDirectory directory;
  const std::string file = directory.file("run.jsonl", text);
  const auto events_from = [&](const std::string& tick) {
    return run_lockstep({"log", "events", file, "--event", "hold", "--event", "release", "--format",
                         "csv", "--from", tick})
        .out;
  };
  const std::string head = "tick,time_s,event,what,value\n";
  const std::string before =
      "1,0.1,hold,T/p/q/s,\n"
      "2,0.2,hold,T/p/q,\n";
  const std::string rest =
      "3,0.3,release,T/p/q,\n"
      "3,0.3,release,T/p/q/s,\n"
      "4,0.4,hold,T/p/q/s,\n"
      "5,0.5,release,T/p/q/s,\n";
  CHECK(events_from("0") == head + before + rest);
  CHECK(events_from("3") == head + rest);  // the line of tick 2 has the whole state
}

TEST_CASE("log events: each question of an Ask, also one that is asked again with the same text") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      "<root lockstep=\"1\"><BehaviorTree ID=\"T\"><Repeat name=\"r\" times=\"2\">"
      "<Ask name=\"a\" text=\"Is it, {on}?\" timeout=\"0.2\" default=\"yes\"/></Repeat>"
      "</BehaviorTree></root>");
  const std::string file = directory.path("run.jsonl");
  REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--rate", "10", "--record", file,
                        "--set", "on=now"})
              .code == 0);
  const Outcome outcome =
      run_lockstep({"log", "events", file, "--event", "ask", "--format", "csv"});
  CHECK(outcome.err == "");
  CHECK(outcome.out ==
        "tick,time_s,event,what,value\n"
        "0,0,ask,T/r/a,\"Is it, now?\"\n"
        "3,0.3,ask,T/r/a,\"Is it, now?\"\n");
}

TEST_CASE(
    "log events: --event takes each event that docs/recording.md lists, and there are no others") {
  const TemporaryDirectory directory;
  events(directory);
  std::set<std::string> listed;
  const std::string page = read_file(LOCKSTEP_SOURCE_DIR "/docs/recording.md");
  for (const std::string& line : lines(page.substr(page.find("| Event | When |")))) {
    if (line.empty()) break;
    const std::string cell = line.substr(0, line.find('|', 1));
    for (auto at = cell.find('`'); at != cell.npos; at = cell.find('`', at + 1)) {
      const auto end = cell.find('`', at + 1);
      listed.insert(cell.substr(at + 1, end - at - 1));
      at = end;
    }
  }
  CHECK(listed == std::set<std::string>(kEventNames.begin(), kEventNames.end()));
  for (const std::string& name : listed) {
    const Outcome outcome =
        run_lockstep({"log", "events", directory.path("run.jsonl.zst"), "--event", name});
    INFO(name << outcome.err);
    CHECK(outcome.code == 0);
    for (const std::string& line : lines(outcome.out)) CHECK(contains(line, ' ' + name + ' '));
  }
}

TEST_CASE("log events: an unknown event is refused with what there is") {
  const Outcome outcome = run_lockstep({"log", "events", "run.jsonl", "--event", "stop"});
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "start"));
}

}  // namespace lockstep::host::test

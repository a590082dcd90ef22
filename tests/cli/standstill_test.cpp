// Standstills from outside: what a run says of them, and how --stall-fail ends them.
#include <algorithm>
#include <catch2/catch.hpp>

#include "support/json.h"
#include "support/program.h"

using namespace lockstep::host::test;
using nlohmann::json;

namespace {

struct StandingProject {
  explicit StandingProject(const std::string& content)
      : file(directory.file(
            "tree.xml", "<root lockstep=\"1\"><plugin name=\"motion\"/>" + content + "</root>")) {}

  Outcome run(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"run", file, "--clock", "virtual"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const bool has_limit = std::ranges::find(more, "--max-ticks") != more.end();
    if (!has_limit) arguments.insert(arguments.end(), {"--max-ticks", "400"});
    return run_lockstep(std::move(arguments));
  }
  // Nothing else is on stderr.
  std::string warnings(std::vector<std::string> more) const {
    more.insert(more.end(), {"--view", "none"});
    const std::string all = run(std::move(more)).err;
    const auto first = all.find("\nwarning: ");  // behind what check says of the tree
    return first == std::string::npos ? all : all.substr(first + 1);
  }

  TemporaryDirectory directory;
  std::string file;
};

std::string tree(const std::string& content) {
  return "<BehaviorTree ID=\"Main\">" + content + "</BehaviorTree>";
}
std::string advance(const std::string& name, const std::string& step) {
  return "<Advance name=\"" + name + "\" step=\"" + step + "\"/>";
}
std::string sync(const std::string& name, const std::string& barrier, const std::string& child) {
  return "<SyncProgress name=\"" + name + "\" barrier=\"" + barrier + "\">" + child +
         "</SyncProgress>";
}
std::string use(const std::string& name, const std::string& keep, const std::string& child) {
  return "<UseResources name=\"" + name + "\" pool=\"arms\" resources=\"left\" keep=\"" + keep +
         "\">" + child + "</UseResources>";
}

// coarse holds c2, in which f2 is; fine holds f1, in which c1 is.
const std::string kNestedBarriers =
    "<barrier name=\"coarse\" barriers=\"0.5\"/><barrier name=\"fine\" barriers=\"0.25\"/>" +
    tree("<Parallel name=\"p\">" + sync("c1", "coarse", sync("f1", "fine", advance("x", "0.05"))) +
         sync("c2", "coarse",
              "<Sequence name=\"s\" memory=\"true\">" + advance("a", "0.1") +
                  sync("f2", "fine", advance("y", "0.05")) + "</Sequence>") +
         "</Parallel>");

const std::string kThroughSynchronized =
    "<barrier name=\"g\" barriers=\"0.5\"/><barrier name=\"h\" barriers=\"0.5\"/>" +
    tree("<Parallel name=\"p\"><ParallelRelative name=\"r\" delta=\"0.1\">" +
         sync("g1", "g", advance("x", "0.05")) + "<Sequence name=\"s\" memory=\"true\">" +
         advance("a", "0.1") + sync("h1", "h", advance("b", "0.05")) +
         "</Sequence></ParallelRelative><Sequence name=\"t\" memory=\"true\">" +
         sync("h2", "h", advance("d", "0.05")) + sync("g2", "g", advance("y", "0.05")) +
         "</Sequence></Parallel>");

// It looks like a circle, and is none.
const std::string kNoCircle =
    "<barrier name=\"g\" barriers=\"0.5\"/><barrier name=\"h\" barriers=\"0.5\"/>" +
    tree("<Parallel name=\"p\"><ParallelAbsolute name=\"r\" barriers=\"0.5\">" +
         sync("g1", "g", advance("x", "0.05")) + advance("a", "0.1") +
         "</ParallelAbsolute><ParallelAbsolute name=\"q\" barriers=\"0.25\">" +
         sync("g2", "g", advance("y", "0.05")) + "<Sequence name=\"t\" memory=\"true\">" +
         advance("e", "0.1") + sync("h2", "h", advance("d", "0.05")) +
         "</Sequence></ParallelAbsolute>" + sync("h1", "h", advance("z", "0.05")) + "</Parallel>");

const std::string kKept =
    "<resources name=\"arms\"/>" +
    tree("<ParallelRelative name=\"r\" delta=\"0.2\">" + use("u1", "true", advance("x", "0.05")) +
         use("u2", "false", advance("y", "0.05")) + "</ParallelRelative>");

const std::string kKeptAtBarrier =
    "<resources name=\"arms\"/><barrier name=\"b\" barriers=\"0.5\"/>" +
    tree("<Parallel name=\"r\">" + use("u1", "true", sync("m1", "b", advance("x", "0.05"))) +
         use("u2", "false", sync("m2", "b", advance("y", "0.05"))) + "</Parallel>");

std::string pull(const std::string& arm) {
  return "<ParallelAbsolute name=\"pull\" barriers=\"0.5\">" + arm + advance("base", "0.1") +
         "</ParallelAbsolute>";
}

}  // namespace

TEST_CASE("standstill: a circle of barriers is one warning, with its links") {
  CHECK(StandingProject(kNestedBarriers).warnings({"--stall", "1"}) ==
        "warning: a deadlock since 0.100 s: coarse -> fine -> coarse\n"
        "  'coarse' holds 'c2' at 0.525 until 'c1' comes, which is at 0.25 and has 'f1' in it\n"
        "  'fine' holds 'f1' at 0.25 until 'f2' comes, which is at 0.05 and is inside of 'c2'\n");
  CHECK(StandingProject(kThroughSynchronized).warnings({"--stall", "1"}) ==
        "warning: a deadlock since 0.140 s: r -> g -> h -> r\n"
        "  'r' holds 's' at 0.625 until 'g1' comes, which is at 0.5\n"
        "  'g' holds 'g1' at 0.5 until 'g2' comes, which does not run and comes after 'h2'\n"
        "  'h' holds 'h2' at 0.5 until 'h1' comes, which is at 0.25 and is inside of 's'\n");
}

TEST_CASE("standstill: a circle through a pool names the owner") {
  CHECK(StandingProject(kKept).warnings({"--stall", "1"}) ==
        "warning: a deadlock since 0.050 s: r -> arms -> r\n"
        "  'r' holds 'u1' at 0.25 until 'u2' comes, which is at 0\n"
        "  'arms' keeps left from 'u2' until 'u1' gives it back, which is at 0.25\n");
  CHECK(
      StandingProject(kKeptAtBarrier).warnings({"--stall", "1"}) ==
      "warning: a deadlock since 0.100 s: arms -> b -> arms\n"
      "  'arms' keeps left from 'u2' until 'u1' gives it back, which is at 0.5 and has 'm1' in it\n"
      "  'b' holds 'm1' at 0.5 until 'm2' comes, which does not run and is inside of 'u2'\n");
}

TEST_CASE("standstill: what ends by itself is none") {
  const Outcome outcome = StandingProject(kNoCircle).run({"--stall", "0.2", "--view", "none"});
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
}

TEST_CASE("standstill: waiting for an owner that works is none") {
  const StandingProject project("<resources name=\"arms\"/>" +
                                tree("<Parallel>" + use("u1", "true", advance("x", "0.005")) +
                                     use("u2", "false", advance("y", "0.1")) + "</Parallel>"));
  CHECK(project.warnings({"--stall", "0.5", "--stall-fail", "1"}).empty());
}

TEST_CASE("standstill: a node that waits for an owner says so") {
  const StandingProject project("<resources name=\"arms\"/>" +
                                tree("<Parallel>" + use("u1", "true", advance("work", "0.0001")) +
                                     "<ParallelAbsolute name=\"pull\" barriers=\"0.5\">" +
                                     advance("x", "0.1") + use("u2", "false", advance("y", "0.1")) +
                                     "</ParallelAbsolute></Parallel>"));
  CHECK(project.warnings({"--stall", "1"}) ==
        "warning: Main/Parallel/pull/u2 waits for left, which 'u1' owns, and the other children of "
        "'pull' wait for it since 0.050 s\n");
}

TEST_CASE("standstill: nodes that wait for the same one are one warning, with the way to it") {
  const StandingProject project(
      "<barrier name=\"one\" barriers=\"0.5\"/><barrier name=\"two\" barriers=\"0.25\"/>" +
      tree("<Parallel>" + sync("o1", "one", sync("t1", "two", advance("x", "0.05"))) +
           sync("o2", "one", advance("a", "0.25")) + sync("t2", "two", advance("slow", "0")) +
           "</Parallel>"));
  CHECK(project.warnings({"--stall", "1"}) ==
        "warning: Main/Parallel/t2/slow makes no progress at 0 since 0.050 s and holds the other "
        "members of 'two' back\n"
        "  'one' holds 'o2' at 0.5 until 'o1' comes, which is at 0.25 and has 't1' in it\n");
}

TEST_CASE("standstill: who waits for one that does not run, or has failed, is reported so") {
  const StandingProject idle("<barrier name=\"lift\" barriers=\"0.5\"/>" +
                             tree("<Parallel><Fallback memory=\"true\"><AlwaysSuccess/>" +
                                  sync("l1", "lift", advance("arm", "0.1")) + "</Fallback>" +
                                  sync("l2", "lift", advance("base", "0.3")) + "</Parallel>"));
  CHECK(idle.warnings({"--stall", "1"}) ==
        "warning: Main/Parallel/Fallback/l1/arm does not run, and the other members of 'lift' wait "
        "for it since 0.020 s\n");
  const StandingProject failed(
      tree("<ParallelAbsolute name=\"pull\" barriers=\"0.5\" success_count=\"1\" "
           "failure_count=\"2\"><AlwaysFailure name=\"safe\"/>" +
           advance("base", "0.1") + "</ParallelAbsolute>"));
  const std::string warning = failed.warnings({"--stall", "1"});
  CHECK((warning.empty() ||
         contains(warning, "Main/pull/safe has failed, and the other children of 'pull' wait")));
}

TEST_CASE("standstill: the summary has it, and the exit code is that of the run") {
  const Outcome outcome = StandingProject(kNestedBarriers).run({"--stall", "1", "--view", "none"});
  CHECK(outcome.code == 124);
  CHECK(contains(outcome.out,
                 "note: a deadlock since 0.100 s: coarse -> fine -> coarse\n"
                 "  'coarse' holds 'c2' at 0.525 until"));
}

TEST_CASE("standstill: the summary as JSON has its links") {
  const Outcome outcome =
      StandingProject(kKeptAtBarrier).run({"--stall", "1", "--view", "none", "--json"});
  const json summary = parse_json(outcome.out);
  REQUIRE(summary["standstills"].size() == 1);
  const json& it = summary["standstills"][0];
  CHECK(it["cause"] == "circle");
  CHECK(it["since_s"] == 0.1);
  CHECK(it["time_s"] == 1.11);
  CHECK_FALSE(it.contains("failed"));
  REQUIRE(it["links"].size() == 2);
  CHECK(it["links"][0] == json{{"node", "Main/arms"},
                               {"kind", "resources"},
                               {"waiting", "Main/r/u2"},
                               {"waiting_at", 0.0},
                               {"awaited", "Main/r/u1"},
                               {"awaited_at", it["links"][0]["awaited_at"]},
                               {"awaited_status", "running"},
                               {"resources", "left"}});
  CHECK(it["links"][1]["node"] == "Main/b");
  CHECK(it["links"][1]["awaited_status"] == "idle");
  REQUIRE(summary["notes"].size() == 1);
  CHECK(contains(summary["notes"][0].get<std::string>(), "arms -> b -> arms; 'arms' keeps left"));
}

TEST_CASE("standstill: --stall-fail ends it, and a Retry begins again") {
  const StandingProject project(
      tree("<Retry attempts=\"2\">" + pull(advance("arm", "0")) + "</Retry>"));
  const Outcome outcome = project.run({"--stall-fail", "1", "--view", "none"});
  CHECK(outcome.code == 1);
  // base is held from tick 5 of each attempt on.
  CHECK(outcome.err ==
        "warning: Main/Retry/pull is halted and fails: Main/Retry/pull/arm makes no progress at 0 "
        "since 0.050 s and holds the other children of 'pull' back\n"
        "warning: Main/Retry/pull is halted and fails: Main/Retry/pull/arm makes no progress at 0 "
        "since 1.120 s and holds the other children of 'pull' back\n");
  CHECK(contains(outcome.out, "failure after 214 ticks"));
  CHECK(contains(outcome.out, "pull (ParallelAbsolute): failure: it stood still (--stall-fail)\n"));
  CHECK(contains(outcome.out,
                 "Retry: failure, 2 attempts failed\n"
                 "      - tick 106: pull: it stood still (--stall-fail)\n"
                 "      - tick 213: pull: it stood still (--stall-fail)\n"));
  CHECK(contains(outcome.out, "Main/Retry/pull was halted and failed at 2.130 s\n"));
  CHECK(contains(outcome.out, "    arm   did not wait\n"));
}

TEST_CASE(
    "standstill: a Fallback reacts to --stall-fail, at the same time with or without --stall") {
  const StandingProject project(tree("<Fallback memory=\"true\">" + pull(advance("arm", "0")) +
                                     advance("let_go", "0.5") + "</Fallback>"));
  for (const std::string stall : {"0", "0.5", "1", "5"}) {
    const Outcome outcome = project.run({"--stall-fail", "1", "--stall", stall, "--json"});
    INFO(stall);
    CHECK(outcome.code == 0);
    const json summary = parse_json(outcome.out);
    CHECK(summary["ticks"] == 108);
    REQUIRE(summary["standstills"].size() == 1);
    CHECK(summary["standstills"][0]["failed"] == "Main/Fallback/pull");
    CHECK(summary["standstills"][0]["failed_s"] == 1.06);
    CHECK(summary["standstills"][0]["time_s"] == (stall == "0.5" ? 0.56 : 1.06));
    CHECK(contains(outcome.err, "tick 106     Main/Fallback/pull/arm: halted\n"));
    CHECK(contains(outcome.err, "tick 106     Main/Fallback/let_go: started\n"));
  }
}

TEST_CASE("standstill: of a circle, the lowest node that contains it fails") {
  const auto failed = [](const std::string& project) {
    const Outcome outcome =
        StandingProject(project).run({"--stall-fail", "1", "--view", "none", "--json"});
    CHECK(outcome.code == 1);
    const json summary = parse_json(outcome.out);
    CHECK(summary["why_failed"].back()["stood_still"] == true);
    return summary["standstills"][0]["failed"].get<std::string>();
  };
  CHECK(failed(kNestedBarriers) == "Main/p");
  CHECK(failed(kThroughSynchronized) == "Main/p");
  CHECK(failed(kKept) == "Main/r");
  CHECK(failed(kKeptAtBarrier) == "Main/r");
}

TEST_CASE("standstill: the recording has the node's Failure, and a line about it") {
  const StandingProject project(
      tree("<Retry attempts=\"2\">" + pull(advance("arm", "0")) + "</Retry>"));
  const std::string file = project.directory.path("run.jsonl");
  project.run({"--stall-fail", "1", "--record", file, "--view", "none"});
  const auto recorded = lines(read_file(file));
  REQUIRE(recorded.size() > 107);
  const json tick = parse_json(recorded[107]);
  CHECK(tick["tick"] == 106);
  REQUIRE(tick["logs"].size() == 1);
  CHECK(tick["logs"][0][0] == "Main/Retry/pull");
  CHECK(tick["logs"][0][1] == "warning");
  CHECK(contains(tick["logs"][0][2].get<std::string>(), "Main/Retry/pull is halted and fails: "));
  CHECK(tick["nodes"][0] == json{1, "failure", 0.0, 1, 0});
  const Outcome info = run_lockstep({"log", "info", file});
  CHECK(info.code == 0);
  CHECK(contains(info.out, "    arm   did not wait\n"));
  const Outcome scenario = run_lockstep({"log", "scenario", file, project.file});
  CHECK(scenario.code == 0);
  CHECK(contains(scenario.err,
                 "'--stall-fail' ended 'Main/Retry/pull' in tick 106: the scenario waits on"));
}

TEST_CASE("standstill: what reads a recording knows that --stall-fail ended a node") {
  const auto record = [](const StandingProject& project) {
    std::string file = project.directory.path("run.jsonl");
    project.run({"--stall-fail", "1", "--record", file, "--view", "none"});
    return file;
  };
  const StandingProject retry(
      tree("<Retry attempts=\"2\">" + pull(advance("arm", "0")) + "</Retry>"));
  const std::string retried = record(retry);
  const std::string path =
      "    Retry: failure, 2 attempts failed\n"
      "      - tick 106: pull: it stood still (--stall-fail)\n"
      "      - tick 213: pull: it stood still (--stall-fail)\n"
      "      pull (ParallelAbsolute): failure: it stood still (--stall-fail)\n";
  CHECK(contains(run_lockstep({"log", "why", retried}).out, path));
  CHECK(contains(run_lockstep({"log", "info", retried}).out, path));
  CHECK(contains(run_lockstep({"log", "info", retried}).out,
                 "  --stall-fail ended 2 stalls, first 'Main/Retry/pull' in tick 106\n"));
  CHECK(run_lockstep({"log", "why", retried, "arm"}).out ==
        "'Main/Retry/pull/arm' was halted in tick 213, when 'Main/Retry/pull' failed\n"
        "    pull (ParallelAbsolute): failure: it stood still (--stall-fail)\n");
  const json links = parse_json(run_lockstep({"log", "why", retried, "--json"}).out)["links"];
  CHECK(links.back()["stood_still"] == true);
  CHECK_FALSE(links.front().contains("stood_still"));

  // Another child decides later.
  const StandingProject fallback(tree("<Fallback memory=\"true\">" + pull(advance("arm", "0")) +
                                      "<AlwaysFailure name=\"let_go\"/></Fallback>"));
  CHECK(contains(run_lockstep({"log", "why", record(fallback)}).out,
                 "    Fallback: failure (2 of 2 children)\n"
                 "      - pull: it stood still (--stall-fail)\n"));
}

TEST_CASE("standstill: a run that comes to none is the same with --stall-fail, byte for byte") {
  const StandingProject project(kNoCircle);
  const std::string with = project.directory.path("with.jsonl");
  const std::string without = project.directory.path("without.jsonl");
  CHECK(project.run({"--stall-fail", "0.2", "--record", with}).code == 0);
  CHECK(project.run({"--record", without}).code == 0);
  CHECK(read_file(with) == read_file(without));
}

TEST_CASE("standstill: however often it comes, the messages are bounded") {
  const StandingProject project(
      tree("<Retry attempts=\"1000000\">" + pull(advance("arm", "0")) + "</Retry>"));
  const Outcome outcome =
      project.run({"--stall-fail", "0.001", "--max-ticks", "2000", "--json", "--view", "none"});
  CHECK(outcome.code == 124);
  CHECK(lines(outcome.err).size() < 30);
  const json summary = parse_json(outcome.out);
  CHECK(summary["standstills"].size() == 20);
  REQUIRE(summary["notes"].size() == 8);  // two of them of leaves that are halted again and again
  CHECK(contains(summary["notes"][7].get<std::string>(), " standstills more"));
}

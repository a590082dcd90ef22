// Barriers across branches from outside: what a run says of them, its recording says too.
#include <catch2/catch.hpp>

#include "support/json.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

Outcome barrier_command(std::vector<std::string> arguments) {
  return run_lockstep(std::move(arguments));
}

std::string barrier_project(const std::string& content) {
  return "<root lockstep=\"1\"><plugin name=\"motion\"/>" + content + "</root>";
}

const std::string kBarrierX1 = barrier_project(
    "<barrier name=\"lift\" barriers=\"0.5;1\"/><BehaviorTree ID=\"Main\"><Parallel>"
    "<SyncProgress name=\"one\" barrier=\"lift\"><Advance name=\"arm\" "
    "step=\"0.1\"/></SyncProgress>"
    "<SyncProgress barrier=\"lift\"><Advance name=\"base\" step=\"0.3\"/></SyncProgress>"
    "</Parallel></BehaviorTree>");

// One joins late, from an idle place, and the names of the leaves are the same.
const std::string kBarrierLate = barrier_project(
    "<barrier name=\"lift\" delta=\"0.2\" idle=\"ignore\"/><BehaviorTree ID=\"Main\"><Parallel>"
    "<Sequence name=\"late\" memory=\"true\"><Wait seconds=\"0.04\"/>"
    "<SyncProgress barrier=\"lift\"><Advance name=\"arm\" step=\"0.1\"/></SyncProgress></Sequence>"
    "<SyncProgress barrier=\"lift\"><Advance name=\"arm\" step=\"0.1\"/></SyncProgress>"
    "</Parallel></BehaviorTree>");

struct BarrierRun {
  TemporaryDirectory directory;
  std::string file;
  Outcome run;

  explicit BarrierRun(const std::string& tree) : file(directory.path("run.jsonl")) {
    run = barrier_command({"run", directory.file("tree.xml", tree), "--clock", "virtual", "--view",
                           "plain", "--record", file});
  }
};

// From the line about the barrier on.
std::string of_barrier(const std::string& text) {
  const auto begin = text.find("  Main/lift (barrier");
  return begin == std::string::npos ? "" : text.substr(begin);
}

double barrier_measure(const BarrierRun& recorded, const std::string& measure) {
  const Outcome outcome =
      barrier_command({"log", "measure", recorded.file, "--measure", measure, "--json"});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  for (const auto& row : parse_json(outcome.out)) {
    if (row["node"] != "Main/Parallel") return row["value"];
  }
  return -1;
}

}  // namespace

TEST_CASE("the spread has no bound where the first tick of a node was not the last in its period") {
  const auto tree = [](const std::string& beside) {
    return "<root BTCPP_format=\"4\"><plugin name=\"motion\"/><BehaviorTree ID=\"Main\"><Parallel>"
           "<ParallelAbsolute name=\"sync\" barriers=\"0.25;0.5\"><Advance name=\"a\" "
           "step=\"0.01\"/><Advance name=\"b\" step=\"0.5\"/></ParallelAbsolute>" +
           beside + "</Parallel></BehaviorTree></root>";
  };
  constexpr auto kAgain = "<AsyncSequence><AlwaysSuccess/><AlwaysSuccess/></AsyncSequence>";
  constexpr auto kSaid = "'Main/Parallel/sync/a' rose in a period with several ticks";
  for (const std::string beside : {kAgain, "<AlwaysSuccess/>"}) {
    const BarrierRun recorded(tree(beside));
    const std::string info = barrier_command({"log", "info", recorded.file}).out;
    for (const std::string& text : {recorded.run.out + recorded.run.err, info}) {
      INFO(text);
      CHECK(contains(text, "largest spread 0.49"));
      CHECK(contains(text, "(bound ") == (beside != kAgain));
      CHECK(contains(text, kSaid) == (beside == kAgain));
    }
  }
}

TEST_CASE("the spread has a bound in a recording that begins within a run") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml", barrier_project("<BehaviorTree ID=\"Main\"><ParallelAbsolute barriers=\"0.5;1\">"
                                  "<Advance name=\"a\" step=\"0.001\"/><Advance name=\"b\" "
                                  "step=\"0.002\"/></ParallelAbsolute></BehaviorTree>"));
  const std::string file = directory.path("run.jsonl");
  const Outcome run =
      barrier_command({"run", tree, "--clock", "virtual", "--view", "none", "--record", file,
                       "--record-rotate", "4s", "--record-keep", "1"});
  INFO(run.err);
  const Outcome info = barrier_command({"log", "info", directory.path("run.0003.jsonl")});
  INFO(info.out << info.err);
  CHECK(info.code == 0);
  CHECK(contains(info.out, "(bound "));
  CHECK_FALSE(contains(info.out, "several ticks"));
}

TEST_CASE("barrier: a run explains it like a synchronized node, and its recording says the same") {
  const BarrierRun recorded(kBarrierX1);
  CHECK(recorded.run.code == 0);
  CHECK(contains(recorded.run.err, "base: waits for arm at barrier 0.5 of 'lift'"));
  CHECK(contains(recorded.run.err, "base: continues after 0.030 s"));
  CHECK(of_barrier(recorded.run.out) ==
        "  Main/lift (barrier, 10 ticks)\n"
        "    progress distance 2.1, mean 0.21 a tick\n"
        "    largest spread 0.4 (bound 0.8), longest step 0.3\n"
        "    arm   did not wait\n"
        "    base  waited 1 time, 0.030 s in 3 ticks\n");
  CHECK(of_barrier(barrier_command({"log", "info", recorded.file}).out) ==
        of_barrier(recorded.run.out));
  CHECK(barrier_measure(recorded, "progress-distance") == Approx(2.1));
  CHECK(barrier_measure(recorded, "held:base") == 3);
  CHECK(barrier_measure(recorded, "pauses:base") == 1);
  CHECK(barrier_measure(recorded, "held:one") == 0);  // the SyncProgress stands for its child
}

TEST_CASE("barrier: who is idle and ignored is in no measure, live and recorded") {
  const BarrierRun recorded(kBarrierLate);
  CHECK(recorded.run.code == 0);
  // With 0.4 ahead, the first waits for the other to be within 0.2; there is no bound to that.
  CHECK(of_barrier(recorded.run.out) ==
        "  Main/lift (barrier, 14 ticks)\n"
        "    progress distance 2, mean 0.1429 a tick\n"
        "    largest spread 0.4, longest step 0.1\n"
        "    late/…/arm      did not wait\n"
        "    Parallel/…/arm  waited 1 time, 0.020 s in 2 ticks\n");
  CHECK(of_barrier(barrier_command({"log", "info", recorded.file}).out) ==
        of_barrier(recorded.run.out));
}

TEST_CASE("barrier: replay and drawings show it by its name") {
  const BarrierRun recorded(kBarrierX1);
  const Outcome replay = barrier_command({"replay", recorded.file, "--at", "3", "--print"});
  CHECK(contains(replay.out, "waits for arm at barrier 0.5 of 'lift'"));
  CHECK(contains(replay.out, "lift (barrier)"));
  const std::string tree = recorded.directory.path("tree.xml");
  CHECK(contains(barrier_command({"show", tree}).out, "barrier 'lift' barriers=\"0.5;1\""));
  CHECK(contains(barrier_command({"show", tree, "--format", "dot"}).out, "n5 -> n3 [style=dashed"));
  CHECK(contains(barrier_command({"show", tree, "--format", "mermaid"}).out, "n5 -.- n3"));
  const std::string image = recorded.directory.path("plot.svg");
  CHECK(barrier_command({"log", "plot", recorded.file, "--out", image}).code == 0);
}

TEST_CASE("barrier: --stall names who never comes, and the barrier") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      barrier_project(
          "<barrier name=\"lift\" barriers=\"0.5\"/><BehaviorTree ID=\"Main\"><Parallel>"
          "<Fallback memory=\"true\"><AlwaysSuccess/><SyncProgress barrier=\"lift\">"
          "<Advance name=\"arm\" step=\"0.1\"/></SyncProgress></Fallback>"
          "<SyncProgress barrier=\"lift\"><Advance name=\"base\" step=\"0.3\"/></SyncProgress>"
          "</Parallel></BehaviorTree>"));
  const Outcome outcome = barrier_command(
      {"run", tree, "--clock", "virtual", "--view", "none", "--max-ticks", "300", "--stall", "2"});
  CHECK(contains(outcome.out + outcome.err,
                 "arm does not run, and the other members of 'lift' wait for it since 0.020 s"));
}

TEST_CASE("barrier: its path is its own where the root has its name") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      barrier_project("<barrier name=\"lift\" delta=\"0.1\"/><BehaviorTree ID=\"Main\">"
                      "<Parallel name=\"lift\">"
                      "<SyncProgress barrier=\"lift\"><Advance step=\"0.1\"/></SyncProgress>"
                      "<SyncProgress barrier=\"lift\"><Advance step=\"0.3\"/></SyncProgress>"
                      "</Parallel></BehaviorTree>"));
  const std::string file = directory.path("run.jsonl");
  REQUIRE(barrier_command({"run", tree, "--clock", "virtual", "--view", "none", "--record", file})
              .code == 0);
  const Outcome info = barrier_command({"log", "info", file});
  CHECK(info.code == 0);
  CHECK(contains(info.out, "Main/lift#2 (barrier"));
}

TEST_CASE("barrier: a recording whose members are no nodes is refused") {
  BarrierRun recorded(kBarrierX1);
  const std::string line = "\"members\":[2,4]";
  for (const std::string wrong : {"\"members\":[4,2]", "\"members\":[2,9]", "\"members\":[-1]",
                                  "\"members\":\"x\"", "\"members\":[]"}) {
    std::string text = read_file(recorded.file);
    const auto at = text.find(line);
    REQUIRE(at != std::string::npos);
    text.replace(at, line.size(), wrong);
    const Outcome info =
        barrier_command({"log", "info", recorded.directory.file("bad.jsonl", text)});
    INFO(wrong << ": " << info.out << info.err);
    CHECK(info.code == 3);
  }
}

TEST_CASE("barrier: a member that is skipped after it has succeeded is at 1 in a recording, too") {
  const TemporaryDirectory directory;
  const std::string file = directory.path("run.jsonl");
  const std::string tree = directory.file("tree.xml", R"(<root lockstep="1"><plugin name="motion"/>
<barrier name="g" barriers="1"/><BehaviorTree ID="T"><Sequence memory="true"><Script code="x := 0"/><Parallel memory="false">
<SyncProgress barrier="g"><Advance name="a" step="1" on_success="x := 1" skip_if="x == 1"/></SyncProgress>
<SyncProgress barrier="g"><Advance name="b" step="0.1"/></SyncProgress></Parallel></Sequence></BehaviorTree></root>)");
  const Outcome run =
      run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--record", file});
  CHECK(contains(run.out, "progress distance 4.5,"));
  const Outcome measured =
      run_lockstep({"log", "measure", file, "--measure", "progress-distance:g"});
  CHECK(contains(measured.out, " 4.5\n"));
}

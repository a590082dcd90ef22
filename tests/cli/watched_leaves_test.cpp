// `run --watch-leaves` and `run --require-ticket`: a leaf that does what its leaf model does not
// allow has a fault. The leaves of the runs play scripts.
#include <catch2/catch.hpp>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

const std::string kTwoAndCharge =
    R"(<root lockstep="1"><plugin name="motion"/><plugin name="fetch"/>
<BehaviorTree ID="T"><Sequence memory="true">
<ParallelAbsolute name="both" barriers="0.25;0.5;0.75"><Advance name="a"/><Advance name="b"/></ParallelAbsolute>
<Repeat times="3"><ForceSuccess><Sequence memory="true" name="s">
<BatteryAbove name="low" level="0.5"/><BatteryAbove name="high" level="0.5"/><Charge name="charge"/>
</Sequence></ForceSuccess></Repeat></Sequence></BehaviorTree></root>
)";

const std::string kGood = R"(@rate 10
T/Sequence/both/a = R0.3 R0.6 R0.8 S
T/Sequence/both/b = R0.3 R0.6 R0.8 S
T/Sequence/Repeat/ForceSuccess/s/low = S
T/Sequence/Repeat/ForceSuccess/s/high = S
T/Sequence/Repeat/ForceSuccess/s/charge = R S R S R S
)";

struct WatchedFiles {
  TemporaryDirectory directory;
  std::string tree = directory.file("t.xml", kTwoAndCharge);
  std::string text = kGood;
  std::string leaves = directory.file("t.leaves", text);

  // Replaces the script of a leaf.
  void play(const std::string& leaf, const std::string& words) {
    const auto begin = text.find("/" + leaf + " = ") + leaf.size() + 4;
    text.replace(begin, text.find('\n', begin) - begin, words);
    directory.file("t.leaves", text);
  }
  std::string model(const std::string& rows) {
    return directory.file("t.leaves.xml", "<leaves lockstep=\"1\">\n" + rows + "</leaves>\n");
  }
  Outcome run(const std::string& rows, std::vector<std::string> more = {}) {
    std::vector<std::string> words{"run",     tree,      "--leaves",       leaves,
                                   "--clock", "virtual", "--watch-leaves", model(rows),
                                   "--view",  "none"};
    words.insert(words.end(), more.begin(), more.end());
    return run_lockstep(words);
  }
};

struct Broken {
  std::string leaf, words, rows, message;
};

}  // namespace

TEST_CASE("a run whose leaves keep to their model ends as without it") {
  WatchedFiles files;
  const Outcome outcome = files.run(R"(<fact name="full" changes="never" starts="true"/>
<leaf of="Advance" result="success" ticks="4" step="0..1" finish="full"/>
<leaf of="BatteryAbove" fact="full"/>
<leaf of="Charge" result="success" ticks="2..3" sets="full=true"/>
)");
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
}

TEST_CASE(
    "a leaf that breaks its model has a fault that names the leaf, the assumption and its row") {
  const Broken broken[] = {
      {"a", "R0.3 R0.6 R0.8 R0.9 S", R"(<leaf of="Advance" ticks="2..4"/>)",
       "takes more than 4 ticks, the leaf model allows 2 to 4 (.*t.leaves.xml:2)"},
      {"a", "R0.3 S", R"(<leaf of="Advance" ticks="3..inf"/>)",
       "took 2 ticks, the leaf model allows 3 or more (.*t.leaves.xml:2)"},
      {"a", "R0.3 F", R"(<leaf of="Advance" result="success"/>)",
       "had the result failure, which the leaf model does not allow (.*t.leaves.xml:2)"},
      {"a", "R0.3 K", "",
       "had the result skipped, which the leaf model does not allow (assumed of each leaf without "
       "a row)"},
      {"a", "R0.3 R0.6 R0.3 S", "",
       "moved from 0.6 to 0.3 in a tick, which the leaf model does not allow (assumed of each leaf "
       "without a row)"},
      {"a", "R0.3 R0.8 S", R"(<leaf of="Charge" ticks="1..9"/>
<leaf path="*/a" step="0..1"/>)",
       "moved from 0.3 to 0.8 in a tick, which the leaf model does not allow (.*t.leaves.xml:3)"},
      {"a", "R0.3 R0.3 S", R"(<leaf path="*/a" step="0..1" finish="full"/>)",
       "succeeded from progress 0.3, but the leaf model has finish=\"full\" and a step that does "
       "not reach 1 from there (.*t.leaves.xml:2)"},
      {"high", "F", R"(<fact name="full"/><leaf of="BatteryAbove" fact="full"/>)",
       "had the result failure, but 'T/Sequence/Repeat/ForceSuccess/s/low' has read the opposite "
       "of the fact 'full' in the same tick (.*t.leaves.xml:2)"},
      {"low", "S F S", R"(<fact name="full" changes="never"/><leaf path="*/low" fact="full"/>)",
       "had the result failure, but the fact 'full' was true, and the leaf model has "
       "changes=\"never\" (.*t.leaves.xml:2)"},
      {"low", "F S S",
       R"(<fact name="full" changes="falls" starts="false"/><leaf path="*/low" fact="full"/>)",
       "had the result success, but the fact 'full' was false, and the leaf model has "
       "changes=\"falls\" (.*t.leaves.xml:2)"},
      {"charge", "R S", R"(<fact name="full" changes="never"/><leaf path="*/low" fact="full"/>
<leaf of="Charge" sets="full=false"/>)",
       "had the result success, but the fact 'full' was false, and the leaf model has "
       "changes=\"never\" (.*t.leaves.xml:2)"},
  };
  for (const Broken& it : broken) {
    WatchedFiles files;
    files.play(it.leaf, it.words);
    const std::string record = files.directory.path("run.jsonl");
    const Outcome outcome = files.run(it.rows, {"--record", record});
    INFO(it.message << '\n' << outcome.err << outcome.out);
    CHECK(outcome.code == 5);
    const auto path = it.message.find(".*");
    const std::string first = it.message.substr(0, path),
                      rest = path == std::string::npos ? "" : it.message.substr(path + 2);
    CHECK(contains(outcome.err, first));
    CHECK(contains(outcome.err, rest));
    CHECK(contains(read_file(record), "\"fault\":\"T/Sequence/"));
    // The recording has the same.
    const Outcome checked =
        run_lockstep({"log", "check", record, "--leaves", files.directory.path("t.leaves.xml")});
    INFO(checked.out << checked.err);
    CHECK(checked.code == 1);
    CHECK(contains(checked.out, rest.empty() ? first : first.substr(0, first.size() - 2)));
  }
}

TEST_CASE("a leaf that moves while it is held breaks its model") {
  WatchedFiles files;
  files.play("a", "R0.5 ~0.6 ~0.7 S");
  files.play("b", "R0.1 R0.2 R0.3 S");
  const Outcome outcome = files.run("");
  INFO(outcome.err);
  CHECK(outcome.code == 5);
  CHECK(contains(outcome.err, "while it was held, the leaf model has held=\"still\""));
}

TEST_CASE(
    "a leaf that stands still is not blamed where nodes use another progress, or in two moments") {
  // A member of a barrier that has succeeded counts as 1 there until it ends.
  const std::string again = R"(<root lockstep="1"><plugin name="motion"/>
<barrier name="C" barriers="0.5"/><BehaviorTree ID="T"><Parallel>
<ParallelRelative delta="0.5" name="pair">
<Repeat times="2"><SyncProgress barrier="C"><Advance name="a"/></SyncProgress></Repeat>
<Advance name="b"/></ParallelRelative>
<SyncProgress barrier="C"><Advance name="c"/></SyncProgress></Parallel></BehaviorTree></root>)";
  const std::string of_again = R"(@rate 10
T/Parallel/pair/Repeat/SyncProgress/a = S R0.5 R0.875 S
T/Parallel/pair/b = R0 R0 R0 R0 R0.5 S
T/Parallel/SyncProgress/c = S
)";
  // In its first tick, `a` is ticked and then held.
  const std::string twice = R"(<root BTCPP_format="4"><plugin name="motion"/>
<BehaviorTree ID="T"><Parallel failure_count="1">
<AsyncSequence><Advance name="x"/><Advance name="y"/></AsyncSequence>
<ParallelRelative delta="0.25" name="pair"><Advance name="a"/><Advance name="b"/>
</ParallelRelative></Parallel></BehaviorTree></root>)";
  const std::string of_twice = R"(@rate 10
T/Parallel/AsyncSequence/x = S
T/Parallel/AsyncSequence/y = R0 R0 R0 R0 R0 S
T/Parallel/pair/a = R0.375 S
T/Parallel/pair/b = R0 R0.3 R0.5 S
)";
  for (const auto& [tree, words] : {std::pair(again, of_again), std::pair(twice, of_twice)}) {
    WatchedFiles files;
    files.directory.file("t.xml", tree);
    files.directory.file("t.leaves", words);
    const std::string rows = R"(<leaf of="Advance" result="success;failure"/>)";
    const std::string recording = files.directory.path("r.jsonl");
    const Outcome outcome = files.run(rows, {"--record", recording});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(run_lockstep(
              {"log", "check", recording, "--leaves", files.model(rows), "--tree-file", files.tree})
              .code == 0);
  }
}

TEST_CASE("a leaf that writes what or when its model does not allow breaks it") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><plugin name="motion"/>
<BehaviorTree ID="T"><Sequence memory="true"><Script code="x := 0.0"/>
<Advance name="a" actual="{x}" failure_if="x &gt; 1"/></Sequence></BehaviorTree></root>)");
  const std::string leaves = directory.file(
      "t.leaves", "@rate 10\nT/Sequence/a = R0.2[actual=0.5] R0.5[actual=0.75] S[actual=1]\n");
  const auto play = [&](const std::string& row) {
    return run_lockstep(
        {"run", tree, "--leaves", leaves, "--clock", "virtual", "--view", "none", "--watch-leaves",
         directory.file("t.leaves.xml",
                        "<leaves lockstep=\"1\"><leaf of=\"Advance\" " + row + "/></leaves>")});
  };
  CHECK(play(R"(out.actual="0.5|0.75|1")").code == 0);
  CHECK(play(R"(out.actual="0.5|0.75|1" writes="tick")").code == 0);
  const Outcome early = play(R"(out.actual="0.5|0.75|1" writes="success")");
  INFO(early.err);
  CHECK(early.code == 5);
  CHECK(contains(early.err, "wrote 'x' without a success"));
  const Outcome other = play(R"(out.actual="0.5|1")");
  CHECK(other.code == 5);
  CHECK(contains(other.err, "wrote 0.75 to 'x', which the leaf model does not allow"));
}

TEST_CASE("on-fault fail: a leaf that breaks its model fails in its next tick") {
  WatchedFiles files;
  files.play("a", "R0.3 R0.1 R0.8 S");
  const std::string record = files.directory.path("run.jsonl");
  const Outcome outcome = files.run("", {"--on-fault", "fail", "--record", record, "--json"});
  INFO(outcome.err << outcome.out);
  CHECK(outcome.code == 1);
  const Outcome events = run_lockstep({"log", "events", record});
  INFO(events.out);
  CHECK(contains(events.out, "moved from 0.3 to 0.1 in a tick"));
  // That is the failure of the run, not one that its model rules out.
  const Outcome once = files.run(R"(<leaf path="*/a" result="success"/>)", {"--on-fault", "fail"});
  INFO(once.err << once.out);
  CHECK(once.code == 1);
  CHECK(contains(once.err + once.out, "moved from 0.3 to 0.1"));
  CHECK_FALSE(contains(once.err + once.out, "had the result failure"));
  // One that has completed keeps its result.
  files.play("a", "R0.3 S");
  const Outcome kept = files.run(R"(<leaf path="*/a" ticks="3"/>)", {"--on-fault", "fail"});
  INFO(kept.err);
  CHECK(kept.code == 0);
  CHECK(contains(kept.err + kept.out, "took 2 ticks, the leaf model allows 3"));
}

TEST_CASE("a leaf that starts again after a cut takes its ticks from there on") {
  WatchedFiles files;
  files.play("a", "R0.3 R0.3 R0.6 R0.8 S");
  files.play("b", "R0.3 R0.3 R0.6 R0.8 S");
  const std::string row = R"(<leaf of="Advance" ticks="2..4" result="success"/>)";
  CHECK(files.run(row).code == 5);
  files.text.insert(0, "@cut 1\n");
  files.directory.file("t.leaves", files.text);
  const Outcome outcome = files.run(row);
  INFO(outcome.err << outcome.out);
  CHECK(outcome.code == 0);
}

TEST_CASE("watch-leaves: the rate is that of the model, and another one is refused") {
  WatchedFiles files;
  const std::string tree = files.directory.file(
      "w.xml",
      R"(<root lockstep="1"><BehaviorTree ID="T"><Wait seconds="1"/></BehaviorTree></root>)");
  const std::string model =
      files.directory.file("w.leaves.xml", "<leaves lockstep=\"1\" rate=\"20\"/>\n");
  const Outcome same = run_lockstep({"run", tree, "--clock", "virtual", "--watch-leaves", model});
  CHECK(same.code == 0);
  CHECK(contains(same.out, "21 ticks"));
  const Outcome other =
      run_lockstep({"run", tree, "--clock", "virtual", "--watch-leaves", model, "--rate", "10"});
  CHECK(other.code == 3);
  CHECK(contains(other.err, "counts ticks at 20 per second"));
  CHECK(run_lockstep({"run", tree, "--watch-leaves", files.directory.path("none.xml")}).code == 3);
  CHECK(files.run("<leaf of=\"Grip\" ticks=\"1\"/>").code == 3);
}

TEST_CASE("a ticket: the leaves of the run are watched with the leaf model of the proof") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><plugin name="motion"/>
<BehaviorTree ID="T"><Advance name="a" step="0.25"/></BehaviorTree></root>)");
  const std::string ticket = directory.path("t.json");
  const auto prove = [&](const std::string& row) {
    return run_lockstep(
               {"verify", tree, "--ticket", ticket, "--leaves",
                directory.file("t.leaves.xml", "<leaves lockstep=\"1\">\n" + row + "</leaves>\n")})
        .code;
  };
  const auto play = [&] {
    return run_lockstep({"run", tree, "--clock", "virtual", "--require-ticket", ticket});
  };
  REQUIRE(prove("<leaf of=\"Advance\" ticks=\"4\"/>") == 0);
  const Outcome good = play();
  INFO(good.err);
  CHECK(good.code == 0);
  REQUIRE(prove("<leaf of=\"Advance\" ticks=\"2..3\"/>") == 0);
  const Outcome bad = play();
  INFO(bad.err);
  CHECK(bad.code == 5);
  CHECK(contains(bad.err, "takes more than 3 ticks, the leaf model allows 2 to 3"));
  CHECK(contains(bad.err, "t.json:2)"));
  const Outcome both =
      run_lockstep({"run", tree, "--require-ticket", ticket, "--watch-leaves", ticket});
  CHECK(both.code == 2);
}

TEST_CASE("a leaf that breaks its model has not fallen back: its Failure changes no measure") {
  for (const std::string words : {"R0.2 R0.2 R0.2 S", "R0.3 R0.3 R0.3 S"}) {  // ticked, held
    WatchedFiles files;
    files.play("a", words);
    files.play("b", "R0.1 R0.15 R0.2 S");
    const Outcome outcome =
        files.run(R"(<leaf path="*/a" ticks="1"/>)", {"--on-fault", "fail", "--max-ticks", "9"});
    INFO(words << '\n' << outcome.out << outcome.err);
    CHECK(contains(outcome.out, "takes more than 1 tick"));
    CHECK(contains(outcome.out, "(bound "));
    CHECK_FALSE(contains(outcome.out, "fell"));
  }
}

// The leaves of these runs do by chance what their models allow: it is the judge of what is
// watched.
TEST_CASE("leaves that do by chance what a model allows never break it") {
  const TemporaryDirectory directory;
  const std::string rows[] = {
      "",
      R"(<leaf path="*" step="0..2" finish="full"/>)",
      R"(<leaf path="*" ticks="2..5"/>)",
      R"(<leaf path="*" step="-1..2" held="-1..1" progress="grid:10"/>)",
      R"(<leaf path="*" progress="grid:20" step="0..1" finish="full" result="success" ticks="1..30"/>)",
  };
  int runs = 0;
  for (const char* tree : {"door_pulling", "fetch_and_carry", "grip_again", "museum_guide",
                           "nested", "paper/example5", "two_robots", "btcpp", "philosophers"}) {
    for (const std::string& row : rows) {
      const std::string model =
          directory.file("t.leaves.xml", "<leaves lockstep=\"1\" rate=\"10\">" + row + "</leaves>");
      for (const char* seed : {"1", "2", "3"}) {
        const Outcome outcome =
            run_lockstep({"run", std::string(LOCKSTEP_SOURCE_DIR "/trees/") + tree + ".xml",
                          "--leaves", model, "--watch-leaves", model, "--clock", "virtual",
                          "--seed", seed, "--max-ticks", "200", "--view", "none"});
        INFO(tree << ' ' << row << " seed " << seed << '\n' << outcome.err);
        CHECK((outcome.code <= 1 || outcome.code == 2 || outcome.code == 124));
        runs += outcome.code != 2;  // its grid is not for each delta
      }
    }
  }
  CHECK(runs >= 100);
}

TEST_CASE("what a script of its own node adds to an output is not blamed on a leaf") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root lockstep="1"><BehaviorTree ID="M">
<Sequence memory="true"><Script code="x := 0"/><Action ID="A" o="{x}" on_success="x += 10"/>
<Check code="x >= 10"/><Wait seconds="0.2"/></Sequence></BehaviorTree>
<TreeNodesModel><Action ID="A"><output_port name="o" type="int"/></Action></TreeNodesModel></root>
)");
  const std::string model = directory.file(
      "t.leaves.xml",
      R"(<leaves lockstep="1"><leaf of="A" ticks="2" out.o="0|1" result="success"/></leaves>)");
  const Outcome outcome = run_lockstep({"run", tree, "--mock", "--leaves", model, "--watch-leaves",
                                        model, "--clock", "virtual", "--view", "none"});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
}

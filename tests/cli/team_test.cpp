// Robots in step, from outside: `lockstep team`, and what `run` and `check` say of a tree with a
// team.
#include <catch2/catch.hpp>
#include <string>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"
#include "support/text.h"

using namespace lockstep::host::test;

namespace {

const std::string kCarry = LOCKSTEP_SOURCE_DIR "/trees/carry_together/carry.xml";

Outcome team(std::vector<std::string> more) {
  std::vector<std::string> call{"team", kCarry + ",me=left", kCarry + ",me=right"};
  call.insert(call.end(), more.begin(), more.end());
  return run_lockstep(call);
}

std::string tree_with(const std::string& inside, const std::string& members = "left;right") {
  return "<root lockstep=\"1\"><team name=\"table\" members=\"" + members +
         "\"/><BehaviorTree ID=\"M\">" + inside + "</BehaviorTree></root>\n";
}

}  // namespace

TEST_CASE("lockstep team: the robots of a team are in step, also over a bad network") {
  const Outcome good = team({});
  CHECK(good.code == 0);
  CHECK(good.out ==
        "left   success, 103 ticks, 1.030 s\nright  success, 102 ticks, 1.020 s\n"
        "largest spread 0.01\n");
  const std::vector<std::string> bad{"--latency", "0.05",  "--jitter", "0.02",  "--loss",
                                     "0.1",       "--cut", "0.3..0.8", "--json"};
  const Outcome late = team(bad);
  CHECK(late.code == 0);
  CHECK(late.out == team(bad).out);
  const auto parsed = parse_json(late.out);
  CHECK(parsed["largest_spread"].get<double>() < 0.25);
  CHECK(parsed["robots"]["left"]["seconds"].get<double>() > 1.5);
  const Outcome never = team({"--cut", "0..1000", "--timeout", "3"});
  CHECK(never.code == 1);
  CHECK(contains(never.out, "left   stopped, 300 ticks, 3.000 s: 'right': not heard yet\n"));
}

TEST_CASE("lockstep team: a robot that starts later is waited for, and recorded with the reason") {
  const TemporaryDirectory directory;
  const Outcome late = team({"--start", "0", "2", "--record", directory.path("")});
  CHECK(late.code == 0);
  CHECK(contains(late.out, "left   success, 303 ticks"));
  const Outcome why = run_lockstep({"log", "events", directory.path("left.jsonl")});
  CHECK(contains(why.out, "tick 1        failure  Carry/InStep/right"));
  const std::string text = read_file(directory.path("left.jsonl"));
  CHECK(contains(text, "not heard yet"));
}

TEST_CASE("lockstep team: what cannot be a team is refused") {
  CHECK(contains(run_lockstep({"team", kCarry, kCarry}).err, "two robots are 'left'"));
  const TemporaryDirectory directory;
  const std::string alone = directory.file(
      "alone.xml",
      "<root lockstep=\"1\"><BehaviorTree ID=\"M\"><Wait seconds=\"1\"/></BehaviorTree></root>\n");
  const Outcome none = run_lockstep({"team", alone, kCarry});
  CHECK(none.code == 3);
  CHECK(contains(none.err, "its tree is in no team"));
  for (const char* const cut : {"3", "4..2", "a..b", "-1..2", "1..nan"}) {
    INFO(cut);
    const Outcome outcome = team({"--cut", cut});
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "FROM..UNTIL in seconds"));
  }
}

TEST_CASE(
    "lockstep team: a recording is of the robot that it names, and log why has what it waits for") {
  const TemporaryDirectory directory;
  CHECK(team({"--cut", "0..9", "--timeout", "2", "--record", directory.path("new/folder")}).code ==
        1);
  const std::string right = directory.path("new/folder/right.jsonl");
  CHECK(contains(run_lockstep({"log", "info", right}).out, "me = right"));
  CHECK(contains(run_lockstep({"log", "why", right}).out,
                 "waits for a member of the team that is not heard"));
  CHECK(contains(team({"--start", "1"}).err, "--start: a time for each robot"));
}

TEST_CASE("lockstep team: a member that no file plays is named") {
  const Outcome alone = run_lockstep({"team", kCarry + ",me=left", "--timeout", "1"});
  CHECK(alone.code == 1);
  CHECK(contains(alone.err, "no file is 'right' of the team 'table', so the others wait for it"));
  CHECK_FALSE(contains(team({}).err, "no file is"));
}

TEST_CASE("run: a run in a team is not kept") {
  const TemporaryDirectory directory;
  const Outcome kept = run_lockstep({"run", kCarry, "--checkpoint", directory.path("c")});
  CHECK(kept.code == 2);
  CHECK(contains(kept.err, "--checkpoint: a run in a team cannot be kept"));
}

TEST_CASE("check reports teams that cannot be") {
  const TemporaryDirectory directory;
  const auto check = [&](const std::string& tree) {
    return run_lockstep({"check", directory.file("t.xml", tree)}).err;
  };
  const std::string step =
      R"(<InStep team="table" as="left" delta="0.1"><Wait seconds="1"/></InStep>)";
  CHECK(check(tree_with(step)) == "");
  CHECK(contains(
      check(tree_with(R"(<InStep team="table" as="lef" delta="0.1"><Wait seconds="1"/></InStep>)")),
      "'lef' is not a member of the team 'table'"));
  CHECK(contains(check(tree_with(step, "left;left")), "the member 'left' is given twice"));
  CHECK(contains(check(tree_with(step, "left")), "a team has at least two members"));
  CHECK(contains(check(tree_with("<Sequence>" + step + step + "</Sequence>")),
                 "two nodes of 'M' are in step with the team 'table'"));
  CHECK(contains(check(tree_with(
                     R"(<InStep team="tabel" as="left" delta="0.1"><Wait seconds="1"/></InStep>)")),
                 "unknown team 'tabel'"));
  CHECK(contains(check(tree_with(R"(<InStep team="table" as="left"><Wait seconds="1"/></InStep>)")),
                 "'barriers', 'barrier_count' or 'delta' is missing"));
}

TEST_CASE("in a tree for BehaviorTree.CPP, InStep is what it is in lockstep's language") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "t.xml",
      R"(<root BTCPP_format="4" main_tree_to_execute="M"><team name="table" members="left;right"/>)"
      R"(<BehaviorTree ID="M"><InStep team="table" as="${me}" barriers="0.5"><Sequence>)"
      R"(<Sleep msec="100"/><Sleep msec="100"/></Sequence></InStep></BehaviorTree></root>)");
  const std::string left = directory.file("left.xml", replaced(read_file(tree), "${me}", "left"));
  const std::string right =
      directory.file("right.xml", replaced(read_file(tree), "${me}", "right"));
  const Outcome outcome = run_lockstep({"team", left, right, "--rate", "50"});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "left   success"));
}

TEST_CASE("run: without its team, a robot does not move, and other robots may be scripted") {
  const Outcome other = run_lockstep({"run", kCarry, "--clock", "virtual"});
  CHECK(other.code == 2);
  CHECK(contains(other.err, "--clock virtual: the other robots of the team have another time"));
  const TemporaryDirectory directory;
  const std::string leaves = directory.file("t.leaves",
                                            "@rate 10\nCarry/InStep/lift = R0.2 R0.5 R0.9 S\n"
                                            "Carry/InStep/right = F K R0.1 R0.3 R0.6 R0.8 S\n");
  const Outcome scripted = run_lockstep({"run", kCarry, "--clock", "virtual", "--leaves", leaves});
  INFO(scripted.err);
  CHECK(scripted.code == 0);
}

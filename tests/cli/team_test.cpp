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

std::string tree_of_team(const std::string& inside, const std::string& members = "left;right") {
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

TEST_CASE("after a cut, what other robots do is not listed as that of a leaf") {
  const Outcome it = run_lockstep({"check", kCarry, "--arg", "me=left", "--checkpoint"});
  CHECK(it.code == 0);
  CHECK(contains(it.out, "TeamMember  waits for what the other robots send\n"));
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

TEST_CASE(
    "a run that shares resources with other robots is not kept: run, check and verify say so") {
  const TemporaryDirectory directory;
  const std::string road = LOCKSTEP_SOURCE_DIR "/trees/construction/narrow_road.xml";
  const std::string why = "a run that shares resources with other robots cannot be kept";
  const Outcome kept = run_lockstep({"run", road, "--checkpoint", directory.path("c")});
  CHECK(kept.code == 2);
  CHECK(contains(kept.err, "--checkpoint: " + why));
  CHECK(contains(run_lockstep({"check", road, "--checkpoint"}).out, "nothing continues: " + why));
  const Outcome proof = run_lockstep({"verify", road, "--cuts"});
  CHECK(contains(proof.err, "note: --cuts: " + why));
}

TEST_CASE("check reports teams that cannot be") {
  const TemporaryDirectory directory;
  const auto check = [&](const std::string& tree) {
    return run_lockstep({"check", directory.file("t.xml", tree)}).err;
  };
  const std::string step =
      R"(<InStep team="table" as="left" delta="0.1"><Wait seconds="1"/></InStep>)";
  CHECK(check(tree_of_team(step)) == "");
  CHECK(contains(check(tree_of_team(
                     R"(<InStep team="table" as="lef" delta="0.1"><Wait seconds="1"/></InStep>)")),
                 "'lef' is not a member of the team 'table'"));
  CHECK(contains(check(tree_of_team(step, "left;left")), "the member 'left' is given twice"));
  CHECK(contains(check(tree_of_team(step, "left")), "a team has at least two members"));
  CHECK(contains(check(tree_of_team("<Sequence>" + step + step + "</Sequence>")),
                 "two nodes of 'M' are in step with the team 'table'"));
  CHECK(contains(check(tree_of_team(
                     R"(<InStep team="tabel" as="left" delta="0.1"><Wait seconds="1"/></InStep>)")),
                 "unknown team 'tabel'"));
  CHECK(contains(
      check(tree_of_team(R"(<InStep team="table" as="left"><Wait seconds="1"/></InStep>)")),
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

TEST_CASE(
    "lockstep team: robots share resources, one after the other, and the reason is recorded") {
  const std::string road = LOCKSTEP_SOURCE_DIR "/trees/construction/narrow_road.xml,me=truck_";
  const TemporaryDirectory directory;
  const Outcome all = run_lockstep({"team", road + "1", road + "2", road + "3", "--latency", "0.02",
                                    "--record", directory.path("")});
  CHECK(all.code == 0);
  const Outcome why = run_lockstep({"log", "why", directory.path("truck_3.jsonl"), "--at", "70"});
  CHECK(contains(why.out, "'truck_1' has 'narrow_road'"));
  const Outcome merged = run_lockstep({"log", "merge", directory.path("truck_1.jsonl"),
                                       directory.path("truck_2.jsonl"), "--offset", "truck_2=0",
                                       "-o", directory.path("both.jsonl")});
  CHECK(merged.code == 0);
  CHECK(contains(run_lockstep({"log", "events", directory.path("both.jsonl")}).out,
                 "start    trucks/truck_2/Haul/Sequence/UseResources/drive_out"));
  // The robot that decides ends during a cut, and names the next one when it is over.
  const Outcome cut = run_lockstep(
      {"team", road + "1", road + "2", road + "3", "--cut", "1..8", "--timeout", "20"});
  CHECK(cut.code == 0);
  const Outcome alone = run_lockstep({"team", road + "2", road + "3", "--timeout", "2"});
  CHECK(alone.code == 1);
  CHECK(contains(alone.err, "no file is 'truck_1' of the team 'trucks'"));
  CHECK(contains(alone.out, "truck_2  stopped, 200 ticks, 2.000 s: 'truck_1' is not heard yet"));
}

TEST_CASE(
    "check: a file that is included as another name has its own team, or that of the main file") {
  const TemporaryDirectory directory;
  const std::string team = "<team name=\"trucks\" members=\"a;b\"/>";
  const auto part = [&](const std::string& file, const std::string& declared) {
    directory.file(file,
                   "<root lockstep=\"1\">" + declared +
                       R"(<resources name="roads" team="trucks" as="a" resources="road"/>)"
                       R"(<BehaviorTree ID="Drive"><UseResources pool="roads" resources="road">)"
                       R"(<Wait seconds="1"/></UseResources></BehaviorTree></root>)");
  };
  const auto message = [&](const std::string& file, const std::string& declared) {
    const std::string main = directory.file(
        "main.xml",
        "<root lockstep=\"1\" main_tree_to_execute=\"M\">" + declared + "<include path=\"" + file +
            "\" as=\"north\"/>" +
            R"(<BehaviorTree ID="M"><SubTree ID="north.Drive"/></BehaviorTree></root>)");
    return run_lockstep({"check", main}).err;
  };
  part("own.xml", team);
  part("none.xml", "");
  CHECK(message("own.xml", "") == "");
  CHECK(message("none.xml", team) == "");
  CHECK(contains(message("none.xml", ""), "unknown team 'trucks'"));
}

TEST_CASE("lockstep team: what is only asked for blocks no other node while a barrier holds it") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("t.xml",
                     R"x(<root lockstep="1"><plugin name="motion"/><arg name="me"/>
<team name="t" members="a;b"/><resources name="p" team="t" as="${me}" resources="x"/>
<barrier name="m" barriers="0.5"/>
<BehaviorTree ID="M"><Parallel>
  <SyncProgress barrier="m"><Sequence memory="true">
    <Advance step="0.5"/><UseResources pool="p" resources="x"><Advance step="0.1"/></UseResources>
  </Sequence></SyncProgress>
  <SyncProgress barrier="m"><Sequence memory="true">
    <Wait seconds="0.3"/><UseResources pool="p" resources="x"><Advance step="0.1"/></UseResources>
    <Advance step="0.1"/>
  </Sequence></SyncProgress>
</Parallel></BehaviorTree></root>
)x");
  CHECK(run_lockstep({"team", tree + ",me=a", tree + ",me=b", "--timeout", "9"}).code == 0);
}

TEST_CASE("lockstep team: the missions of a construction site end, and check has nothing to say") {
  const std::string site = LOCKSTEP_SOURCE_DIR "/trees/construction/";
  const std::vector<std::pair<std::string, std::vector<std::string>>> missions{
      {"loading.xml", {"excavator", "truck"}},
      {"narrow_road.xml", {"truck_1", "truck_2", "truck_3"}},
      {"beam.xml", {"west", "east"}}};
  for (const auto& [file, robots] : missions) {
    INFO(file);
    std::vector<std::string> call{"team"};
    for (const std::string& robot : robots) {
      const Outcome check = run_lockstep({"check", site + file, "--arg", "me=" + robot});
      CHECK(check.err == "");
      call.push_back(site + file + ",me=" + robot);
    }
    for (const char* const latency : {"0", "0.2"}) {
      std::vector<std::string> late = call;
      late.insert(late.end(), {"--latency", latency, "--timeout", "60"});
      CHECK(run_lockstep(late).code == 0);
    }
  }
}

TEST_CASE("check: a pool of a team that cannot be shared is refused") {
  const auto message = [](const std::string& pool, const std::string& use) {
    const TemporaryDirectory directory;
    const std::string tree =
        directory.file("t.xml", "<root lockstep=\"1\"><team name=\"t\" members=\"a;b\"/>" + pool +
                                    "<BehaviorTree ID=\"M\">" + use + "</BehaviorTree></root>\n");
    return run_lockstep({"check", tree}).err;
  };
  const std::string use =
      R"(<UseResources pool="p" resources="x"><Wait seconds="1"/></UseResources>)";
  const std::string pool = R"(<resources name="p" team="t" as="a" resources="x;y"/>)";
  CHECK(message(pool, use) == "");
  CHECK(contains(message(R"(<resources name="p" team="t" resources="x"/>)", use),
                 "needs the name of this robot"));
  CHECK(contains(message(R"(<resources name="p" team="t" as="a"/>)", use),
                 "names all of its resources"));
  CHECK(contains(message(R"(<resources name="p" as="a" resources="x"/>)", use),
                 "'as' is for a pool of a team"));
  CHECK(contains(message(R"(<resources name="p" team="t" as="c" resources="x"/>)", use),
                 "'c' is not a member of the team 't'"));
  CHECK(contains(message(R"(<resources name="p" team="u" as="a" resources="x"/>)", use),
                 "unknown team 'u'"));
  CHECK(contains(message(pool + R"(<resources name="q" team="t" as="a" resources="z"/>)",
                         "<Sequence>" + use +
                             R"(<UseResources pool="q" resources="z"><Wait seconds="1"/>)"
                             "</UseResources></Sequence>"),
                 "shares the pool 'p' already"));
  CHECK(contains(
      message(
          pool,
          R"x(<UseResources pool="p" resources="any(x;y)"><Wait seconds="1"/></UseResources>)x"),
      "any(…) of its resources cannot be chosen"));
  CHECK(contains(message(pool, R"(<UseResources pool="p" resources="x" on_change="exchange">)"
                               R"(<Wait seconds="1"/></UseResources>)"),
                 "kept until the child ends"));
  const std::string outer = R"(<UseResources pool="p" resources="y">)";
  CHECK(contains(
      message(pool, outer + use + "</UseResources>"),
      "'UseResources' asks for more of them while this robot has resources of the pool 'p'"));
  const std::string step = R"(<InStep team="t" as="a" delta="0.1"><Wait seconds="1"/></InStep>)";
  CHECK(contains(
      message(pool, outer + step + "</UseResources>"),
      "'InStep' waits for the other robots while this robot has resources of the pool 'p'"));
  CHECK(message(pool, R"(<InStep team="t" as="a" delta="0.1">)" + use + "</InStep>") == "");
  std::string nine = "<Parallel>";
  for (int i = 0; i < 9; ++i) nine += use;
  CHECK(contains(message(pool, nine + "</Parallel>"), "more than 8 nodes use the pool 'p'"));
}

namespace {

// What the leaves of these robots do: a motion that ends.
const std::string kMotions =
    "<leaves lockstep=\"1\" rate=\"10\"><leaf of=\"Advance\" result=\"success\"/></leaves>\n";

Outcome verify(std::vector<std::string> robots, const TemporaryDirectory& directory,
               std::vector<std::string> more = {}) {
  std::vector<std::string> call{"verify", "--out", directory.path("")};
  for (const std::string& it : robots) call.push_back(it);
  for (const std::string& it : more) call.push_back(it);
  return run_lockstep(call);
}

std::vector<std::string> both(const std::string& tree) {
  return {tree + ",me=left", tree + ",me=right"};
}

}  // namespace

TEST_CASE("lockstep verify: the trees of a team are verified together") {
  const TemporaryDirectory directory;
  const std::string leaves = directory.file("m.leaves.xml", kMotions);
  for (const char* const late : {"0", "1", "2"}) {
    INFO(late);
    const Outcome good = verify(both(kCarry), directory, {"--leaves", leaves, "--late", late});
    CHECK(good.code == 0);
    CHECK(contains(good.out, "2 robots, leaf model"));
    CHECK(contains(good.out, "  left                       success\n"));
    CHECK(contains(good.out, "  can always end             yes\n"));
    CHECK(contains(good.out, "  barriers passed too early  never\n"));
    CHECK(contains(good.out, "verified for all behaviors that are assumed\n"));
  }
  const Outcome as_json = verify(both(kCarry), directory, {"--leaves", leaves, "--json"});
  const auto parsed = parse_json(as_json.out);
  CHECK(parsed["results"]["right"].dump() == "[\"success\"]");
  CHECK(parsed["facts"]["can always end"] == "yes");
  CHECK(parsed["findings"].empty());
}

TEST_CASE("lockstep verify: each round of a team has its own barriers") {
  const TemporaryDirectory directory;
  const std::string leaves = directory.file("m.leaves.xml", kMotions);
  std::string text = read_file(kCarry);
  text.replace(text.find("<InStep"), 0, "<Repeat times=\"2\">");
  text.replace(text.find("</InStep>"), 9, "</InStep></Repeat>");
  const Outcome twice =
      verify(both(directory.file("carry.xml", text)), directory, {"--leaves", leaves});
  INFO(twice.out + twice.err);
  CHECK(twice.code == 0);
  CHECK(contains(twice.out, "  can always end             yes\n"));
  CHECK(contains(twice.out, "  barriers passed too early  never\n"));
}

TEST_CASE(
    "lockstep verify: a team of which one robot may fail can no longer end, with recordings") {
  const TemporaryDirectory directory;
  const Outcome alone = verify(both(kCarry), directory);
  CHECK(alone.code == 1);
  CHECK(contains(alone.out, "finding deadlock: after "));
  CHECK(contains(alone.out, "    left: has ended\n    right: 'left': not heard for 0."));
  const Outcome events =
      run_lockstep({"log", "events", directory.path("carry.deadlock.left.jsonl")});
  CHECK(contains(events.out, "failure  Carry/InStep/lift"));
  const Outcome merged = run_lockstep({"log", "merge", directory.path("carry.deadlock.left.jsonl"),
                                       directory.path("carry.deadlock.right.jsonl"), "--out",
                                       directory.path("team.jsonl")});
  CHECK(merged.code == 0);

  // What the user intends is accepted, and with give_up the other one fails as well.
  const std::string accepting =
      directory.file("a.leaves.xml",
                     "<leaves lockstep=\"1\"><accept finding=\"deadlock\" because=\"a person "
                     "comes\"/></leaves>\n");
  const Outcome accepted = verify(both(kCarry), directory, {"--leaves", accepting});
  CHECK(accepted.code == 0);
  CHECK(contains(accepted.out, "    accepted: a person comes\n"));
  std::string text = read_file(kCarry);
  text.replace(text.find("barriers="), 0, "give_up=\"2\" ");
  const Outcome gives_up = verify(both(directory.file("carry.xml", text)), directory);
  CHECK(gives_up.code == 0);
  CHECK(contains(gives_up.out, "  left                       success, failure\n"));
}

TEST_CASE("lockstep verify: robots that wait for each other, or declare their team differently") {
  const TemporaryDirectory directory;
  const std::string leaves = directory.file("m.leaves.xml", kMotions);
  const std::string head =
      "<root lockstep=\"1\" main_tree_to_execute=\"M\"><plugin name=\"motion\"/>"
      "<arg name=\"me\" default=\"left\"/><team name=\"t\" members=\"left;right\"/>"
      "<resources name=\"p\" team=\"t\" as=\"${me}\" resources=\"aisle;door\"/>"
      "<BehaviorTree ID=\"M\"><SubTree ID=\"${me}\"/></BehaviorTree>";
  const std::string in_step =
      "<InStep team=\"t\" as=\"${me}\" barriers=\"0.5\"><Advance/></InStep>";
  const auto uses = [](const std::string& inside, const std::string& what = "aisle") {
    return "<UseResources pool=\"p\" resources=\"" + what + "\">" + inside + "</UseResources>";
  };
  const auto tree = [&](const std::string& left, const std::string& right) {
    return directory.file("t.xml", head + "<BehaviorTree ID=\"left\">" + left +
                                       "</BehaviorTree><BehaviorTree ID=\"right\">" + right +
                                       "</BehaviorTree></root>\n");
  };
  const std::string sequence = "<Sequence memory=\"true\">";
  const Outcome cross =
      verify(both(tree(uses(in_step), sequence + uses("<Advance/>") + in_step + "</Sequence>")),
             directory, {"--leaves", leaves});
  CHECK(cross.code == 1);
  CHECK(contains(cross.out,
                 "    left: waits for 'right', which has not begun\n"
                 "    right: 'left' has 'aisle'\n"));
  CHECK(contains(cross.out, "  two owners of a resource   never\n"));
  const Outcome right = verify(both(tree(sequence + uses("<Advance/>") + in_step + "</Sequence>",
                                         sequence + in_step + uses("<Advance/>") + "</Sequence>")),
                               directory, {"--leaves", leaves});
  INFO(right.out + right.err);
  CHECK(right.code == 0);
  // A node inside of another one asks for itself.
  const Outcome nested = verify(both(tree(uses(uses("<Advance/>", "door")), uses("<Advance/>"))),
                                directory, {"--leaves", leaves});
  INFO(nested.out);
  CHECK(nested.code == 0);

  std::string other = read_file(kCarry);
  other.replace(other.find("0.25;0.5"), 8, "0.25;0.6");
  const Outcome stranger =
      verify({kCarry + ",me=left", directory.file("other.xml", other) + ",me=right"}, directory,
             {"--leaves", leaves});
  CHECK(stranger.code == 1);
  CHECK(contains(stranger.out, "left: 'right': its tree declares the team in another way"));
}

TEST_CASE("lockstep verify: a word may come at any time between two ticks") {
  // `right` waits for ever if it gives up in its last tick but one, before `left` is silent for
  // that whole tick.
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "c.xml",
      "<root lockstep=\"1\" main_tree_to_execute=\"M\"><arg name=\"me\" default=\"left\"/>"
      "<team name=\"t\" members=\"left;right\"/>"
      "<BehaviorTree ID=\"M\"><SubTree ID=\"${me}\"/></BehaviorTree><BehaviorTree ID=\"left\">"
      "<InStep team=\"t\" as=\"left\" barriers=\"0\" give_up=\"1\"><AlwaysFailure/></InStep>"
      "</BehaviorTree><BehaviorTree ID=\"right\"><Sequence memory=\"true\">"
      "<Script code=\"done := false; began := false\"/><Fallback memory=\"true\">"
      "<InStep team=\"t\" as=\"right\" barriers=\"0\" give_up=\"0.1\"><Sequence memory=\"true\">"
      "<Script code=\"began := true\"/><Wait seconds=\"0.6\"/><Script code=\"done := true\"/>"
      "<AlwaysFailure/></Sequence></InStep><WaitUntil code=\"done == true or began == false\"/>"
      "</Fallback></Sequence></BehaviorTree></root>\n");
  const Outcome played = run_lockstep({"team", tree + ",me=left", tree + ",me=right", "--rate",
                                       "10", "--latency", "0.04", "--timeout", "60"});
  CHECK(contains(played.out, "right  stopped"));
  const Outcome outcome = verify(both(tree), directory, {"--late", "0"});
  CHECK(outcome.code == 1);
  CHECK(contains(outcome.out, "finding deadlock: "));
}

TEST_CASE("lockstep verify: what is not looked at, and not known yet") {
  const TemporaryDirectory directory;
  const Outcome stopped = verify(both(kCarry), directory, {"--states", "5"});
  CHECK(stopped.code == 124);
  CHECK(contains(stopped.out, "  left                     not known\n"));
  CHECK(contains(stopped.out, "  can always end           not known\n"));
  CHECK(contains(stopped.out, "  largest spread of table  0 so far\n"));
  const std::string endless =
      directory.file("e.leaves.xml",
                     "<leaves lockstep=\"1\"><tree ends=\"no\"/><fact name=\"light\"/></leaves>\n");
  const Outcome outcome = verify(both(kCarry), directory, {"--leaves", endless});
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "not asked: <tree ends=\"no\"/>"));
  CHECK(contains(outcome.out, "facts belong to one robot"));
}

TEST_CASE("log check: the leaf of a robot that has ended does what its robot does") {
  const TemporaryDirectory directory;
  const auto tree = [&](const std::string& name, const std::string& nodes) {
    return directory.file(
        name,
        "<root lockstep=\"1\"><plugin name=\"motion\"/><arg name=\"me\" default=\"left\"/>"
        "<team name=\"t\" members=\"left;right\"/><BehaviorTree ID=\"T\">" +
            nodes + "</BehaviorTree></root>\n");
  };
  const std::string in_step = "<InStep team=\"t\" as=\"${me}\" barriers=\"0.25;0.75\"",
                    part = "<Advance step=\"0.05\"/></InStep>";
  const std::string left = tree("a.xml", in_step + ">" + part);
  const std::string right = tree("b.xml", "<ForceSuccess><Timeout seconds=\"0.8\">" + in_step +
                                              ">" + part + "</Timeout></ForceSuccess>");
  const std::string model =
      directory.file("m.leaves.xml",
                     "<leaves lockstep=\"1\" rate=\"10\"><leaf of=\"Advance\" result=\"success\" "
                     "progress=\"grid:20\" step=\"1..1\"/></leaves>\n");
  run_lockstep({"team", left + ",me=left", right + ",me=right", "--rate", "10", "--max-ticks", "40",
                "--record", directory.path("r")});
  const std::string recording = directory.path("r/left.jsonl");
  REQUIRE(contains(read_file(recording), "\"right\""));
  const Outcome outcome = run_lockstep({"log", "check", recording, "--leaves", model});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
}

TEST_CASE("properties of trees of a team: verify and team have a verdict of each, of each robot") {
  const TemporaryDirectory directory;
  const auto carry_with = [&](const std::string& properties) {
    std::string text = read_file(kCarry);
    text.replace(text.find("<BehaviorTree"), 0, properties);
    return both(directory.file("carry.xml", text));
  };
  const std::vector<std::string> files = carry_with(
      "<property name=\"low\">never lift.progress > 0.3</property>"
      "<property name=\"works\">never lift.failure</property>"
      "<property name=\"comes\">lift.running leads to lift.done</property>");
  const std::string model = directory.file("m.leaves.xml",
                                           "<leaves lockstep=\"1\"><leaf path=\"*/lift\" "
                                           "result=\"success\" progress=\"grid:10\"/></leaves>\n");
  const Outcome proof = verify(files, directory, {"--leaves", model});
  INFO(proof.out + proof.err);
  CHECK(proof.code == 1);
  for (const std::string robot : {"left", "right"}) {
    CHECK(contains(proof.out, "finding property/low." + robot + ": "));
    CHECK(contains(proof.out, "property 'works' of " + robot));
    const std::string recording =
        directory.path("carry.property.low." + robot + '.' + robot + ".jsonl");
    CHECK(contains(run_lockstep({"log", "check", recording}).out, "violated"));
  }
  for (const std::string of :
       {"'works' of left ", "'works' of right", "'comes' of left ", "'comes' of right"})
    CHECK(contains(proof.out, "property " + of + "  holds\n"));
  const Outcome played = run_lockstep({"team", files[0], files[1]});
  CHECK(played.code == 0);
  CHECK(contains(played.out, "property low: violated in tick "));
  CHECK(contains(played.out, "property works: holds"));
  CHECK(contains(run_lockstep({"team", "--json", files[0], files[1]}).out,
                 R"("verdict": "violated")"));
  // Where a run may be endless, nothing is known of what it waits for.
  const std::string endless = directory.file("e.leaves.xml",
                                             "<leaves lockstep=\"1\"><tree ends=\"no\"/><leaf "
                                             "path=\"*/lift\" result=\"success\"/></leaves>\n");
  CHECK(contains(verify(files, directory, {"--leaves", endless}).out,
                 "not known: a run may be endless"));
}

TEST_CASE("a robot gets more of a shared pool although one that waits for it has waited longer") {
  const TemporaryDirectory directory;
  const auto tree = [&](const std::string& a, const std::string& b) {
    return directory.file(
        "n.xml",
        "<root lockstep=\"1\" main_tree_to_execute=\"M\"><plugin name=\"motion\"/>"
        "<arg name=\"me\" default=\"left\"/><team name=\"t\" members=\"left;right\"/>"
        "<resources name=\"p\" team=\"t\" as=\"${me}\" resources=\"x;y\"/>"
        "<BehaviorTree ID=\"M\"><SubTree ID=\"${me}\"/></BehaviorTree><BehaviorTree ID=\"left\">" +
            a + "</BehaviorTree><BehaviorTree ID=\"right\">" + b + "</BehaviorTree></root>\n");
  };
  const std::string part = "<Advance step=\"0.1\"/>";
  const auto uses = [](const std::string& what, const std::string& inside) {
    return "<UseResources pool=\"p\" resources=\"" + what + "\">" + inside + "</UseResources>";
  };
  const std::string nested =
      uses("x", "<Sequence memory=\"true\">" + part + uses("y", part) + "</Sequence>");
  const auto play = [&](const std::string& file) {
    return run_lockstep({"team", file + ",me=left", file + ",me=right", "--timeout", "20"});
  };
  CHECK(play(tree(nested, uses("x;y", part))).code == 0);
  // One whose tree uses nothing of the pool takes no part in it, also where it is the first member.
  const std::string in_step =
      "<InStep team=\"t\" as=\"${me}\" barriers=\"0.5\">" + part + "</InStep>";
  const std::string both_of =
      "<Sequence memory=\"true\">" + in_step + uses("x", part) + "</Sequence>";
  for (const bool is_first : {true, false}) {
    const Outcome outcome = play(tree(is_first ? both_of : in_step, is_first ? in_step : both_of));
    INFO(outcome.out + outcome.err);
    CHECK(outcome.code == 0);
  }
}

TEST_CASE("lockstep verify: what says nothing of several robots is refused") {
  const TemporaryDirectory directory;
  for (const std::string option : {"--fmea", "--probability", "--cuts=1", "--compact"}) {
    INFO(option);
    const Outcome outcome = verify(both(kCarry), directory, {option});
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "is for one tree, and here are several"));
  }
  CHECK(contains(verify({kCarry}, directory, {"--late", "2"}).err,
                 "for the trees of several robots"));
  CHECK(contains(verify({kCarry, kCarry}, directory).err, "two robots are 'left'"));
  const std::string leaves = directory.file(
      "m.leaves.xml", "<leaves lockstep=\"1\"><leaf of=\"Advanc\" result=\"success\"/></leaves>\n");
  const Outcome unknown = verify(both(kCarry), directory, {"--leaves", leaves});
  CHECK(unknown.code == 3);
  CHECK(contains(unknown.err, "the tree has no leaf of type 'Advanc'"));
}

TEST_CASE("lockstep team: with a leaf model, the leaves do what it allows") {
  const TemporaryDirectory directory;
  const std::string leaves = directory.file(
      "m.leaves.xml",
      "<leaves lockstep=\"1\"><leaf of=\"Advance\" result=\"failure\" ticks=\"3\"/></leaves>\n");
  const Outcome outcome = team({"--leaves", leaves, "--timeout", "5"});
  CHECK(outcome.code == 1);
  CHECK(contains(outcome.out, "failure, "));
  // The rate is that of the model, and a robot that comes later hears nothing of one that is gone.
  std::string text = read_file(kCarry);
  text.replace(text.find("barriers="), 0, "give_up=\"1\" ");
  const std::string tree = directory.file("carry.xml", text);
  const Outcome late = run_lockstep({"team", tree + ",me=left", tree + ",me=right", "--leaves",
                                     directory.file("s.leaves.xml", kMotions), "--timeout", "5",
                                     "--start", "0", "1.4"});
  CHECK(contains(late.out, "left   failure, 12 ticks, 1.200 s\n"));
  INFO(late.out);
  CHECK(contains(late.out, "right  failure, 12 ticks, 1.200 s"));
}

TEST_CASE("lockstep check: trees that declare a team differently are noted") {
  const TemporaryDirectory directory;
  const auto tree = [&](const char* name, const char* barriers) {
    return directory.file(
        name, tree_of_team("<InStep team=\"table\" as=\"" + std::string(name).substr(0, 4) +
                               "\" barriers=\"" + barriers + "\"><Wait seconds=\"1\"/></InStep>",
                           "left;righ"));
  };
  const std::string left = tree("left.xml", "0.5"), right = tree("righ.xml", "0.6");
  const Outcome outcome = run_lockstep({"check", left, right, "--strict"});
  CHECK(outcome.code == 0);
  CHECK(
      contains(outcome.err + outcome.out, "the team 'table' is declared in another way than at "));
  const Outcome same = run_lockstep({"check", left, tree("righ.xml", "0.5")});
  CHECK(!contains(same.err + same.out, "in another way"));
}

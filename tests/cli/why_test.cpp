// Why a node failed, waits or does not run: the summary of a run and `lockstep log why`, for leaves
// of each kind.
#include <catch2/catch.hpp>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

constexpr const char* kSeeing = R"(#!/usr/bin/python3
from lockstep_leaf import Action, Condition, Failed, Waiting, serve

class See(Action):
    def start(self):
        self.frames = 0
    def tick(self):
        self.frames += 1
        if self.frames < 3:
            return Waiting(f"frame {self.frames} of 3")
        raise Failed("the camera is dark")

class Lift(Action):
    def tick(self):
        return Waiting("force 3 of 10 N")

class Broken(Action):
    def tick(self):
        raise OSError("no device")

class Spoiled(Action):
    def start(self):
        self.ticks = 0
    def progress(self):
        return float("nan") if self.ticks == 2 else 0.1
    def tick(self):
        self.ticks += 1
        return Waiting("goes on")

class Twice(Action):
    def tick(self):
        return Waiting("a", "b")

class IsOpen(Condition):
    def tick(self):
        return Failed("the door is closed")

serve()
)";

struct SeeingRun {
  Outcome run;
  std::string file;
};

SeeingRun record_seeing(const TemporaryDirectory& directory, const std::string& nodes,
                        const std::vector<std::string>& more = {},
                        const std::string& declared = {}) {
  const std::string program = directory.file("seeing.py", kSeeing);
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::string tree =
      directory.file("tree.xml", "<root lockstep=\"1\">" + declared + "<BehaviorTree ID=\"Main\">" +
                                     nodes + "</BehaviorTree></root>");
  SeeingRun recorded{.run = {}, .file = directory.path("r.jsonl")};
  std::filesystem::remove(recorded.file);
  std::vector<std::string> words{"run",         tree,      "--plugin", program,
                                 "--clock",     "virtual", "--view",   "none",
                                 "--max-ticks", "100",     "--record", recorded.file};
  words.insert(words.end(), more.begin(), more.end());
  recorded.run = run_lockstep(words);
  return recorded;
}

std::string why(const std::string& recording, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"log", "why", recording};
  words.insert(words.end(), more.begin(), more.end());
  const Outcome outcome = run_lockstep(words);
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  return outcome.out;
}

constexpr const char* kRetried =
    "<Sequence memory=\"true\"><AlwaysSuccess/><Retry name=\"look\" attempts=\"2\"><See "
    "name=\"see\"/></Retry></Sequence>";

}  // namespace

TEST_CASE("a failed run tells the reason of each attempt, and log why the same") {
  const TemporaryDirectory directory;
  const auto [run, file] = record_seeing(directory, kRetried);
  const std::string chain =
      "    Sequence: failure\n"
      "      look (Retry): failure, 2 attempts failed\n"
      "        - tick 2: see: the camera is dark\n"
      "        - tick 5: see: the camera is dark\n"
      "        see (See): failure: the camera is dark\n";
  CHECK(run.code == 1);
  CHECK(contains(run.out, "  decided by Main/Sequence/look/see:\n" + chain));
  CHECK(why(file) == "'Main/Sequence' failed in tick 5\n" + chain);
  CHECK(contains(run_lockstep({"log", "info", file}).out, chain));
  const auto told = parse_json(why(file, {"look", "--json"}));
  CHECK(told["tick"] == 5);
  CHECK(told["links"][0]["failed_attempts"] == 2);
  CHECK(told["links"][0]["attempts"][0] ==
        parse_json(
            R"({"tick": 2, "path": "Main/Sequence/look/see", "reason": "the camera is dark"})"));
  CHECK(told["links"][1]["reason"] == "the camera is dark");
}

TEST_CASE("a reason belongs to its tick: what a leaf waits for, and nothing before it begins") {
  const TemporaryDirectory directory;
  const std::string file = record_seeing(directory, kRetried).file;
  CHECK(contains(why(file, {"see", "--at", "1"}), "see (See): running: frame 2 of 3\n"));
  CHECK(contains(why(file, {"--at", "3"}), "look (Retry): running, 1 attempt failed\n"));
  CHECK(contains(why(file, {"--at", "3"}), "see (See): running: frame 1 of 3\n"));
  for (const std::string tick : {"-1", "x", "99999999999999999999"})
    CHECK(run_lockstep({"log", "why", file, "--at", tick}).code == 2);
  CHECK(contains(read_file(file), ",\"reasons\":[[3,\"frame 2 of 3\"]]"));
}

TEST_CASE("conditions, timeouts, halted nodes and nodes that were not reached have reasons") {
  const TemporaryDirectory directory;
  const auto [run, file] =
      record_seeing(directory,
                    "<Fallback memory=\"true\"><IsOpen/>"
                    "<Timeout seconds=\"0.1\"><Wait name=\"long\" seconds=\"5\"/></Timeout>"
                    "<Sequence><Script name=\"set\" code=\"force := 2\"/><Check code=\"force &gt;= "
                    "5\"/></Sequence>"
                    "<See/></Fallback>");
  CHECK(contains(run.out, "      - IsOpen: the door is closed\n"));
  const std::string check =
      "Check: force >= 5 is false: force is 2, since tick 10 by 'Main/Fallback/Sequence/set'";
  CHECK(contains(run.out, "      - " + check + "\n"));
  CHECK(contains(run.out, "      See: failure: the camera is dark\n"));
  CHECK(contains(why(file, {"IsOpen"}), "IsOpen: failure: the door is closed\n"));
  CHECK(contains(why(file, {"Timeout"}),
                 "Timeout: failure: its time was over, 0.1 s after its start; before that, long "
                 "at 0.02\n"));
  CHECK(why(file, {"long"})
            .starts_with("'Main/Fallback/Timeout/long' was halted in tick 10, when "
                         "'Main/Fallback/Timeout' failed\n"));
  CHECK(
      why(file, {"See", "--at", "4"})
          .starts_with("'Main/Fallback/See' was not reached until tick 4: 'Main/Fallback' has not "
                       "come to it\n"));
}

TEST_CASE("of a node that is held, log why tells who holds it, and for whom") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      tree_text("<ParallelAbsolute name=\"carry\" barriers=\"0.5\"><Advance name=\"arm\" "
                "step=\"0.01\"/><Advance name=\"base\" step=\"0.1\"/></ParallelAbsolute>"));
  const std::string file = directory.path("r.jsonl");
  REQUIRE(
      run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--record", file}).code ==
      0);
  const std::string held = why(file, {"base", "--at", "20"});
  CHECK(held.starts_with("'Main/carry/base' was held in tick 20\n"));
  CHECK(contains(held, "'carry' holds 'base' at 0.5 until 'arm' comes, which is at 0.2\n"));
  CHECK(why(file) ==
        "'Main/carry' succeeded in tick 99\n"
        "    carry (ParallelAbsolute): success (2 of 2 children)\n"
        "      arm (Advance): success\n");
}

TEST_CASE("log why of a node that was skipped names the last tick in which it was") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml", tree_text("<Parallel><Wait name=\"never\" seconds=\"1\" skip_if=\"true\"/><Wait "
                            "name=\"on\" seconds=\"0.1\"/></Parallel>"));
  const std::string file = directory.path("r.jsonl");
  REQUIRE(
      run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--record", file}).code ==
      0);
  CHECK(why(file, {"never", "--at", "3"})
            .starts_with("'Main/Parallel/never' was skipped in tick 3\n"));
}

TEST_CASE("log why of what a parallel halts, and of a wait for a parallel") {
  const TemporaryDirectory directory;
  const std::string file =
      record_seeing(directory,
                    "<Parallel name=\"p\" success_count=\"2\"><See name=\"a\"/><Wait name=\"w\" "
                    "seconds=\"5\"/></Parallel>")
          .file;
  CHECK(
      why(file, {"w"})
          .starts_with("'Main/p/w' was halted in tick 2, when 'Main/p' failed\n"
                       "    p (Parallel): failure\n      a (See): failure: the camera is dark\n"));
  const std::string held = directory.path("held.jsonl");
  REQUIRE(run_lockstep({"run", "--example", "nested", "--clock", "virtual", "--view", "none",
                        "--max-ticks", "60", "--record", held})
              .code == 124);
  CHECK(contains(why(held, {"--at", "50"}), "'carry' holds 'base' at "));
}

TEST_CASE("of several nodes that may have written an entry, a reason names each") {
  const TemporaryDirectory directory;
  const auto [run, file] = record_seeing(
      directory,
      "<Sequence memory=\"true\"><Script code=\"x := 1\"/><Parallel name=\"both\">"
      "<Script name=\"one\" code=\"x = 7\"/><Script name=\"two\" code=\"x = 7\"/></Parallel>"
      "<AlwaysSuccess/><Wait seconds=\"0.02\"/><Script code=\"x = 7\"/><Check code=\"x == 1\"/>"
      "</Sequence>");
  const std::string reason =
      "x == 1 is false: x is 7, since tick 0 by 'Main/Sequence/Script' or 'Main/Sequence/both/one' "
      "or "
      "'Main/Sequence/both/two'\n";
  CHECK(contains(run.out, reason));
  CHECK(contains(why(file), reason));
}

TEST_CASE("after a fault, log why has its message") {
  const TemporaryDirectory directory;
  const std::string program = directory.file(
      "broken.py",
      "#!/usr/bin/python3\nfrom lockstep_leaf import Action, serve\nclass Broken(Action):\n"
      "    def tick(self):\n        raise OSError(\"no device\")\nserve()\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::string tree = directory.file(
      "tree.xml", "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><Broken/></BehaviorTree></root>");
  const std::string file = directory.path("r.jsonl");
  CHECK(run_lockstep({"run", tree, "--plugin", program, "--clock", "virtual", "--view", "none",
                      "--record", file})
            .code == 5);
  const std::string told = why(file);
  INFO(told);
  CHECK(contains(told, "; the run ended with a fault: Main/Broken: "));
  CHECK(contains(told, "no device"));
}

TEST_CASE("log why refuses a node that is not there") {
  const TemporaryDirectory directory;
  const std::string file = record_seeing(directory, kRetried).file;
  const Outcome outcome = run_lockstep({"log", "why", file, "se"});
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "no node 'se'"));
}

TEST_CASE("leaves in C++ give reasons, and the same in a separate process") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      "<root lockstep=\"1\"><plugin name=\"fetch\"/><BehaviorTree ID=\"Main\"><Fallback>"
      "<DoorOpen door=\"kitchen\"/><Retry attempts=\"2\"><Grasp object=\"mug\"/></Retry></Fallback>"
      "</BehaviorTree></root>");
  const Outcome outcome = run_lockstep({"run", tree, "--clock", "virtual", "--view", "none"});
  INFO(outcome.err);
  CHECK(contains(outcome.out, "      - DoorOpen: it is closed\n"));
  CHECK(contains(outcome.out, "        - tick 0: Grasp: the mug is not within reach\n"));
  CHECK(contains(outcome.out, "        Grasp: failure: the mug is not within reach\n"));
  CHECK(run_lockstep({"run", tree, "--clock", "virtual", "--view", "none", "--isolate"}).out ==
        outcome.out);
}

TEST_CASE("after a fault that counts as a failure, its message is the reason of the node") {
  const TemporaryDirectory directory;
  const auto [run, file] =
      record_seeing(directory,
                    "<Fallback memory=\"true\"><Broken/>"
                    "<ParallelRelative delta=\"1\"><Spoiled/></ParallelRelative>"
                    "<Script code=\"x := 1 / y\"/></Fallback>",
                    {"--on-fault", "fail", "--set", "y=0"});
  INFO(run.err);
  const std::string chain =
      "    Fallback: failure (3 of 3 children)\n"
      "      - Broken: fault: OSError: no device (seeing.py:19)\n"
      "      - Spoiled: fault: ValueError: progress returned nan, expected a number from 0 to 1\n"
      "      Script: failure: fault: its code: cannot assign inf to 'x', which has the type "
      "double\n";
  CHECK(run.code == 1);
  CHECK(contains(run.out, chain));
  CHECK(contains(why(file), chain));
  CHECK(contains(why(file, {"Broken"}), "Broken: failure: fault: OSError: no device"));
}

TEST_CASE(
    "a node that waits for a pool names who owns what it waits for, and what that waits for") {
  const TemporaryDirectory directory;
  const auto [run, file] = record_seeing(
      directory,
      "<Parallel><Sequence memory=\"true\"><Wait seconds=\"0.05\"/><UseResources name=\"left\" "
      "pool=\"cranes\" resources=\"b\" keep=\"true\"><Lift "
      "name=\"lift\"/></UseResources></Sequence>"
      "<Sequence memory=\"true\"><Wait seconds=\"0.1\"/><Timeout seconds=\"0.2\"><UseResources "
      "name=\"right\" pool=\"cranes\" resources=\"a;b\"><AlwaysRunning/></UseResources></Timeout>"
      "</Sequence></Parallel>",
      {}, "<resources name=\"cranes\" increment=\"1\" resources=\"a;b\"/>");
  INFO(run.out);
  const std::string waits =
      "waits for a;b of the pool cranes, of which 'Main/Parallel/Sequence/left' owns b since tick "
      "5";
  CHECK(contains(why(file, {"right", "--at", "15"}),
                 "right (UseResources): running: " + waits + "; 'lift' there: force 3 of 10 N\n"));
  const std::string over =
      "Timeout: failure: its time was over, 0.2 s after its start; before that, right: " + waits;
  CHECK(contains(run.out, over));
  CHECK(contains(why(file), over));
}

TEST_CASE("a timeout has what a leaf in it waited for") {
  const TemporaryDirectory directory;
  const auto [run, file] =
      record_seeing(directory, "<Timeout seconds=\"0.1\"><Lift name=\"lift\"/></Timeout>");
  const std::string over =
      "its time was over, 0.1 s after its start; before that, lift: force 3 of 10 N\n";
  CHECK(contains(run.out, over));
  CHECK(contains(why(file), over));
}

TEST_CASE("the attempts within a tick count, and only the last one has a reason") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      "<root BTCPP_format=\"4\" main_tree_to_execute=\"Main\"><BehaviorTree ID=\"Main\">"
      "<RetryUntilSuccessful name=\"again\" num_attempts=\"5\"><Sequence><AlwaysSuccess/>"
      "<ScriptCondition name=\"is_3\" code=\"x == 3\"/></Sequence></RetryUntilSuccessful>"
      "</BehaviorTree></root>");
  const std::string file = directory.path("r.jsonl");
  const std::vector<std::string> words{"run",     tree,      "--set",  "x=1",
                                       "--clock", "virtual", "--view", "none"};
  const std::string chain =
      "    again (RetryUntilSuccessful): failure, 5 attempts failed\n"
      "      - tick 0: is_3, 4 times\n"
      "      - tick 0: is_3: x == 3 is false: x is 1\n";
  CHECK(contains(run_lockstep(words).out, chain));
  auto recorded = words;
  recorded.insert(recorded.end(), {"--record", file});
  CHECK(run_lockstep(recorded).code == 1);
  CHECK(contains(why(file), chain));
  CHECK(parse_json(why(file, {"--json"}))["links"][0]["attempts"][0]["times"] == 4);
}

TEST_CASE("in a part of a recording, attempts count from its beginning, and the text says so") {
  const TemporaryDirectory directory;
  record_seeing(directory,
                "<Timeout seconds=\"0.5\"><Retry attempts=\"500\"><See/></Retry></Timeout>",
                {"--record-rotate", "0.2s"});
  const std::string second = directory.path("r.0002.jsonl");
  CHECK(contains(why(directory.path("r.0001.jsonl")), "Retry: running, 6 attempts failed\n"));
  CHECK(contains(why(second, {"--at", "35"}),
                 "Retry: running, 6 attempts failed since tick 20, where this recording begins\n"));
  CHECK(parse_json(why(second, {"--json"}))["links"][1]["attempts_since"] == 20);
  CHECK(
      contains(why(directory.path("r.0003.jsonl")), "Timeout: failure: its time was over; before"));
}

TEST_CASE("a value that is too long to be recorded has its tick and its writer") {
  const TemporaryDirectory directory;
  const std::string file =
      record_seeing(directory,
                    "<Sequence memory=\"true\"><Script name=\"set\" code=\"x := '" +
                        std::string(300, 'a') +
                        "'\"/><Wait seconds=\"0.1\"/><Check code=\"x == 'b'\"/></Sequence>")
          .file;
  CHECK(contains(
      why(file),
      "x == 'b' is false: x is too long to be recorded, since tick 0 by 'Main/Sequence/set'\n"));
}

TEST_CASE("Waiting of a program in Python takes one text") {
  const TemporaryDirectory directory;
  CHECK(contains(record_seeing(directory, "<Twice/>").run.err,
                 "TypeError: Waiting takes one text, not 2: Waiting('a')"));
}

// Leaves that misbehave, one row each: what becomes of the run when they live in its process, and
// when they live in one of their own. docs/reliability.md has the same rows in words.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "reliability/hostile_tree.h"
#include "support/json.h"

namespace lockstep::host::test {
namespace {

using nlohmann::json;
using Strings = std::vector<std::string>;

constexpr int kFaultExit = 5;
constexpr int kCrash = 6;

const Strings kFast = {"--clock", "virtual"};
const Strings kShortLimits = {"--hang-limit", "0.3", "--halt-limit", "2"};

Strings with(Strings options, const Strings& more) {
  options.insert(options.end(), more.begin(), more.end());
  return options;
}

void check(const Outcome& outcome, int code, const Strings& texts) {
  INFO(outcome.err);
  CHECK(outcome.code == code);
  for (const std::string& text : texts) {
    INFO(text);
    CHECK(contains(outcome.err, text));
  }
}

// A misdeed that can be caught is a fault, wherever the plugin lives, in the same words; and a
// Failure when the user says so.
void check_fault(const Misdeed& misdeed, const std::string& message) {
  INFO(misdeed.how << " in " << misdeed.where);
  for (const Where where : {Where::InProcess, Where::Isolated}) {
    INFO((where == Where::Isolated ? "isolated" : "in-process"));
    check(run_hostile(misdeed, where, kFast), kFaultExit,
          {"arm' (Misbehave of plugin 'hostile') failed", message});
    const Outcome outcome =
        run_hostile(misdeed, where, with(kFast, {"--on-fault", "fail", "--json"}));
    check(outcome, 0, {});
    CHECK(parse_json(outcome.out)["result"] == "success");
    CHECK(contains(outcome.out, message));
  }
}

// One that brings down its process: all that is left in-process is to say who it was. Isolated it
// is a fault like any other.
void check_crash(const Misdeed& misdeed, const std::string& in_process,
                 const std::string& isolated) {
  INFO(misdeed.how << " in " << misdeed.where);
  check(run_hostile(misdeed, Where::InProcess, kFast), kCrash,
        {"arm' (Misbehave of plugin 'hostile')", in_process, "backtrace"});
  check(run_hostile(misdeed, Where::Isolated, kFast), kFaultExit,
        {"arm' (Misbehave of plugin 'hostile') failed", isolated});
  const Outcome outcome =
      run_hostile(misdeed, Where::Isolated, with(kFast, {"--on-fault", "fail", "--json"}));
  check(outcome, 0, {});
  CHECK(parse_json(outcome.out)["result"] == "success");
}

}  // namespace

TEST_CASE("a leaf that throws is a fault") {
  for (const std::string where : {"start", "tick", "halt", "pause", "resume", "progress"}) {
    check_fault({"throw exception", where}, "threw an exception: out of reach");
  }
  check_fault({"throw int"}, "threw an exception that is not a std::exception");
  check_fault({"throw foreign"}, "threw an exception that is not a std::exception");
}

TEST_CASE("of what an exception says, 500 bytes are reported and the rest is counted") {
  const std::string shortened = std::string(500, 'x') + " ... (59999500 more bytes)";
  for (const std::string where : {"start", "tick", "halt", "progress"}) {
    check_fault({"throw long", where}, "threw an exception: " + shortened);
  }
  check_fault({"set long error"}, shortened);
  check_fault({"throw null"}, "threw an exception whose what() is NULL");
  check_fault({"throw empty"}, "threw an exception whose what() is empty");
  for (const Where where : {Where::InProcess, Where::Isolated}) {
    const TemporaryDirectory directory;
    const std::string file = directory.path("run.jsonl");
    const Outcome outcome =
        run_hostile({"throw long", "create"}, where, with(kFast, {"--record", file}));
    check(outcome, kFaultExit, {"could not be created: threw an exception: " + shortened});
    CHECK(outcome.err.size() < 2000);
    CHECK(read_file(file).size() < 3000);
  }
}

TEST_CASE("to ask an exception what it is, and to destroy it, is a part of the call") {
  check_crash({"throw crashing what"}, "crashed in tick 0: SIGSEGV", "killed by SIGSEGV");
  for (const std::string how : {"throw hanging what", "throw hanging end"}) {
    const Strings options = with(kFast, kShortLimits);
    check(run_hostile({how}, Where::InProcess, options), kCrash,
          {"arm' (Misbehave of plugin 'hostile') has not returned from tick 0"});
    check(run_hostile({how}, Where::Isolated, options), kFaultExit, {"did not return from tick"});
  }
}

TEST_CASE("a leaf that sets an error is a fault") {
  for (const std::string where : {"start", "tick", "halt", "progress"}) {
    check_fault({"set error", where}, "lost the arm");
  }
}

TEST_CASE("a status that does not exist is a fault") {
  check_fault({"nonsense"}, "returned status 7, expected one of lockstep/leaf.h");
}

TEST_CASE("a progress that is not a number is a fault, one out of range is clamped and told") {
  check_fault({"nan", "progress"}, "reported a progress that is not a number");
  for (const std::string how : {"infinite", "-3", "7"}) {
    for (const Where where : {Where::InProcess, Where::Isolated}) {
      const TemporaryDirectory directory;
      const std::string file = directory.path("run.jsonl");
      const Outcome outcome =
          run_hostile({how, "progress"}, where, with(kFast, {"--record", file, "--json"}));
      const std::string leaf = "the leaf 'Main/plan/ParallelRelative/arm' ";
      const std::string told = "reported the progress " + (how == "infinite" ? "inf" : how) +
                               ": progress is a share from 0 to 1";
      check(outcome, 0,
            {"warning: the leaf 'Main/plan/ParallelRelative/arm' (Misbehave of plugin 'hostile') " +
             told});
      CHECK(outcome.err.find(told) == outcome.err.rfind(told));
      const json notes = parse_json(outcome.out)["notes"];
      REQUIRE(notes.size() == 1);
      CHECK(contains(notes[0], leaf + told));
      CHECK(contains(run_lockstep({"log", "info", file}).out, "  note: " + leaf + told));
      const Outcome csv = run_lockstep({"log", "csv", file});
      const std::string progress = how == "-3" ? "0" : "1";
      CHECK(contains(csv.out, "/arm,running," + progress + ","));
    }
  }
}

TEST_CASE("a study warns of a progress out of range, once for each leaf, and counts the runs") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", hostile_tree({"7", "progress"}));
  const Outcome outcome =
      run_lockstep({"study", tree, "--runs", "40", "--jobs", "2", "--no-plots", "--plugin-path",
                    LOCKSTEP_HOSTILE_DIRECTORY, "--out", directory.path("out")});
  const std::string told =
      tree +
      ": warning: the leaf 'Main/plan/ParallelRelative/arm' (Misbehave of plugin 'hostile') "
      "reported the progress 7: progress is a share from 0 to 1, so it counts as 1 [bad-progress]\n"
      "  hint: first in run 0 of cell 0; in 40 runs in all\n";
  check(outcome, 0, {told});
  CHECK(outcome.err.find(told) == outcome.err.rfind(told));
}

TEST_CASE("a leaf that cannot be created ends the run before its first tick") {
  const TemporaryDirectory directory;
  const std::string file = directory.path("run.jsonl");
  for (const Where where : {Where::InProcess, Where::Isolated}) {
    check(run_hostile({"throw exception", "create"}, where, kFast), kFaultExit,
          {"failed before the first tick: could not be created: threw an exception: out of reach"});
    check(run_hostile({"nonsense", "create"}, where, kFast), kFaultExit,
          {"could not be created: its create returned NULL without an error"});
    const Outcome outcome =
        run_hostile({"throw exception", "create"}, where,
                    with(kFast, {"--record", file, "--view", "plain", "--json"}));
    const json summary = parse_json(outcome.out),
               end = parse_json(lines(read_file(file)).back())["end"];
    CHECK(contains(summary["fault"], "/arm: could not be created: threw an exception"));
    CHECK(end["fault"] == summary["fault"]);
    CHECK(contains(run_lockstep({"log", "info", file}).out,
                   "fault: " + summary["fault"].get<std::string>()));
  }
}

TEST_CASE("a leaf that crashes brings down its own process only") {
  for (const std::string where : {"create", "start", "tick", "progress"}) {
    if (where != "create") check_crash({"segv", where}, "SIGSEGV", "killed by SIGSEGV");
  }
  // The backtrace reads the code there, and crashes itself.
  check_crash({"wild jump"}, "SIGSEGV", "killed by SIGSEGV");
  check_crash({"fpe"}, "SIGFPE", "killed by SIGFPE");
  check_crash({"abort"}, "SIGABRT", "killed by SIGABRT");
  check_crash({"terminate"}, "SIGABRT", "killed by SIGABRT");
  // Not lockstep's own lack of memory, which has another exit code.
  check_crash({"terminate without memory"}, "SIGABRT", "killed by SIGABRT");
  check_crash({"overflow"}, "SIGSEGV", "killed by SIGSEGV");
  check_crash({"exit"}, "called exit", "ended with exit code 3");
  check_crash({"_exit"}, "called exit", "ended with exit code 3");
#if !defined(__SANITIZE_ADDRESS__)  // which fails in a check of its own when a thread unwinds so
  check_crash({"exit thread"}, "SIGABRT", "killed by SIGABRT");
#endif
}

TEST_CASE("a tree can isolate one plugin by itself") {
  const TemporaryDirectory directory;
  std::string text = hostile_tree({"segv"});
  const std::string plain = "<plugin name=\"hostile\"/>";
  text.replace(text.find(plain), plain.size(),
               "<plugin name=\"hostile\" isolate=\"true\"/><plugin name=\"motion\"/>");
  const Outcome outcome =
      run_lockstep({"run", directory.file("tree.xml", text), "--plugin-path",
                    LOCKSTEP_HOSTILE_DIRECTORY, "--clock", "virtual", "--on-fault", "fail"});
  check(outcome, 0, {"killed by SIGSEGV"});
}

}  // namespace lockstep::host::test

// Programs that break their protocol, from outside: the leaf is named, all others are halted in
// order, and nothing outlives lockstep.
#include <signal.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <thread>

#include "cli/program.h"

using namespace lockstep::test;

namespace {

const std::string kPrograms = LOCKSTEP_SOURCE_DIR "/tests/programs";

// The leaf that misbehaves in its third tick, beside one of another process that says what happens
// to it.
std::string misbehaving(const std::string& how, const std::string& hold = "") {
  return R"(<root lockstep="1"><plugin name="hostile" program="hostile.py"/>)"
         R"(<plugin name="steady" program="steady.py")" +
         hold +
         R"(/><BehaviorTree ID="Main"><Parallel><Steady name="steady"/>)"
         R"(<Misbehave name="bad" how=")" +
         how + R"("/></Parallel></BehaviorTree></root>)";
}

struct ProgramRun {
  TemporaryDirectory directory;
  std::string pids = directory.path("pids");
  std::string tree;
  Call call;

  ProgramRun(const std::string& text, std::vector<std::string> more) {
    tree = directory.file("tree.xml", text);
    call.arguments = {"run", tree, "--plugin-path", kPrograms, "--max-ticks", "40"};
    call.arguments.insert(call.arguments.end(), more.begin(), more.end());
    call.environment = {{"PIDS", pids}};
  }

  // Of those that have noted themselves; a killed process needs a moment to be gone.
  bool are_all_gone() const {
    for (int tries = 0; tries < 1000; ++tries) {
      std::ifstream file(pids);
      bool any = false;
      for (pid_t pid = 0; file >> pid;) any |= kill(pid, 0) == 0;
      if (!any) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }
};

struct ProgramMisdeed {
  const char* how;
  const char* fault;
};

const ProgramMisdeed kProgramMisdeeds[] = {
    {"garbage",
     "was killed, since it wrote 'Traceback (most recent call last):', which is no answer: not "
     "JSON when it was to answer tick of 'Main/Parallel/bad'"},
    {"half", "ended with exit code 3 in the middle of a line when it was to answer tick of"},
    {"endless", "was killed, since it wrote a line of more than 1 MiB when it was to answer tick"},
    {"twice",
     "was killed, since it answered a status for 'Main/Parallel/bad', which was not asked"},
    {"wrong_order", "it answered 'done' for 'Main/Parallel/bad', which is to answer tick"},
    {"foreign", "since it spoke of leaf 77, which it does not have"},
    {"status", "the status is 'fine', expected running, success, failure or skipped"},
    {"list", "which is no answer: expected a JSON object"},
    {"closed", "closed its output; it was killed when it was to answer tick of"},
    {"die", "was killed by SIGSEGV (Segmentation fault) when it was to answer tick of"},
    {"end", "ended with exit code 3 when it was to answer tick of 'Main/Parallel/bad'"},
    {"silent", "did not answer"},
    {"error", "Misbehave of plugin 'hostile'"},
    {"error", "the driver is gone"},
    {"own_error", "has said: the bus is gone"},
    {"wrong_type", "set 'width', a port of type double, to another type"},
    {"no_port", "set 'depth', which is no port of it"},
    {"progress", "'progress' is not a number"},
    {"nothing", "expected one of 'status', 'done', 'log' and 'error', or 'progress' alone"},
    {"deep", "which is no answer: expected a JSON object"},
};

void check_misdeed(const ProgramMisdeed& row, const std::string& clock) {
  const ProgramRun it(misbehaving(row.how),
                      {"--clock", clock, "--hang-limit", "0.3", "--halt-limit", "0.5"});
  const Outcome outcome = run(it.call);
  INFO(row.how << " on the " << clock << " clock\n" << outcome.err);
  CHECK(outcome.code == 5);
  CHECK(contains(outcome.err, row.fault));
  CHECK(contains(outcome.err, "the leaf 'Main/Parallel/bad'"));
  CHECK(contains(outcome.err, "Main/Parallel/steady: halted"));
  CHECK(outcome.peak_megabytes < 100);
  CHECK(it.are_all_gone());
}

}  // namespace

TEST_CASE("a program that breaks its protocol is a fault of its leaf, and all others are halted") {
  for (const ProgramMisdeed& row : kProgramMisdeeds) check_misdeed(row, "virtual");
}

TEST_CASE("the same on the wall clock, where no tick waits for the answer") {
  for (const ProgramMisdeed& row : kProgramMisdeeds) check_misdeed(row, "wall");
}

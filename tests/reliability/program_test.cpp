// Programs that break their protocol, from outside: the leaf is named, all others are halted in
// order, and nothing outlives lockstep.
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <deque>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>
#include <utility>

#include "hostile_tree.h"
#include "support/program.h"

using namespace lockstep::host::test;

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

// Asks again and again, for five seconds.
bool becomes_true(const std::function<bool()>& is_true) {
  for (int tries = 0; tries < 1000; ++tries) {
    if (is_true()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

// 'R', 'S', 'T', 'Z', and the parent.
std::pair<char, pid_t> state_of(pid_t pid) {
  const std::string text = read_process_file(pid, "stat");
  const auto name_end = text.rfind(')');
  if (name_end == text.npos) return {};
  std::istringstream rest(text.substr(name_end + 1));
  char state = 0;
  pid_t parent = 0;
  rest >> state >> parent;
  return {state, parent};
}

struct ProgramRun {
  TemporaryDirectory directory;
  std::string pids = directory.path("pids");
  std::string tree;
  Invocation call;

  ProgramRun(const std::string& text, std::vector<std::string> more) {
    tree = directory.file("tree.xml", text);
    call.arguments = {"run", tree, "--plugin-path", kPrograms, "--max-ticks", "40"};
    call.arguments.insert(call.arguments.end(), more.begin(), more.end());
    call.environment = {{"PIDS", pids}};
  }

  void tick_at_most(const std::string& ticks) {
    std::ranges::replace(call.arguments, std::string("40"), ticks);
  }

  // Those that have noted themselves.
  std::vector<pid_t> processes() const {
    std::ifstream file(pids);
    std::vector<pid_t> found;
    for (pid_t pid = 0; file >> pid;) found.push_back(pid);
    return found;
  }

  // Not even a zombie is left. A killed process needs a moment for that.
  bool are_all_gone() const {
    const auto all = processes();
    return !all.empty() && becomes_true([&] {
      return std::ranges::none_of(all, [](pid_t pid) { return kill(pid, 0) == 0; });
    });
  }
};

struct ProgramMisdeed {
  const char* how;
  const char* fault;
  const char* hang_limit = "10";  // in which a program must also have begun
};

const ProgramMisdeed kProgramMisdeeds[] = {
    {"garbage",
     "was killed, since it wrote 'Traceback (most recent call last):', which is not an answer: not "
     "JSON when it was to answer tick of 'Main/Parallel/bad'"},
    {"half", "ended with exit code 3 in the middle of a line when it was to answer tick of"},
    {"endless", "was killed, since it wrote a line of more than 1 MiB when it was to answer tick"},
    {"twice",
     "was killed, since it answered a status for 'Main/Parallel/bad', which has no open request"},
    {"wrong_order", "it answered 'done' for 'Main/Parallel/bad', which must answer tick first"},
    {"foreign", "since it spoke of leaf 77, which it does not have"},
    {"status", "the status is 'fine', expected running, success, failure or skipped"},
    {"list", "which is not an answer: expected a JSON object"},
    {"closed", "closed its output; it was killed when it was to answer tick of"},
    {"die", "was killed by SIGSEGV (Segmentation fault) when it was to answer tick of"},
    {"end", "ended with exit code 3 when it was to answer tick of 'Main/Parallel/bad'"},
    {"silent", "did not answer", "2"},
    {"error", "Misbehave of plugin 'hostile'"},
    {"error", "the driver is gone"},
    {"empty_error", "unknown error"},
    {"own_error", "has reported: the bus is gone"},
    {"wrong_type", "set 'width', a port of type double, to another type"},
    {"no_port", "set 'depth', which is not one of its ports"},
    {"progress", "'progress' is not a number"},
    {"nothing",
     "expected one of 'status', 'done', 'pace', 'log' and 'error', or 'progress' or 'kept' alone"},
    {"deep", "which is not an answer: expected a JSON object"},
};

void check_misdeed(const ProgramMisdeed& row, const std::string& clock) {
  ProgramRun it(misbehaving(row.how),
                {"--clock", clock, "--hang-limit", row.hang_limit, "--timeout", "60"});
  // On the wall clock as many as it takes the program to answer, which is slow on a busy machine.
  if (clock == "wall") it.tick_at_most("100000");
  const Outcome outcome = run(it.call);
  INFO(row.how << " on the " << clock << " clock\n" << outcome.err);
  CHECK(outcome.code == 5);
  CHECK(contains(outcome.err, row.fault));
  CHECK(contains(outcome.err, "the leaf 'Main/Parallel/bad'"));
  CHECK(contains(outcome.err, "Main/Parallel/steady: halted"));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  CHECK(outcome.peak_megabytes < 100);
#endif
  CHECK(it.are_all_gone());
}

}  // namespace

TEST_CASE("a program that breaks its protocol is a fault of its leaf, and all others are halted") {
  for (const ProgramMisdeed& row : kProgramMisdeeds) check_misdeed(row, "virtual");
}

TEST_CASE("the same on the wall clock, where no tick waits for the answer") {
  for (const ProgramMisdeed& row : kProgramMisdeeds) {
    const auto is = [&](const char* how) { return std::string_view(row.how) == how; };
    if (is("garbage") || is("half") || is("endless") || is("twice") || is("closed") || is("die") ||
        is("silent") || is("error")) {
      check_misdeed(row, "wall");
    }
  }
}

TEST_CASE("a program that sleeps in a tick costs no other leaf its tick, and is named") {
  ProgramRun it(
      R"(<root lockstep="1"><plugin name="hostile" program="hostile.py"/><plugin name="motion"/>)"
      R"(<BehaviorTree ID="Main"><Parallel><Misbehave name="bad" how="slow"/>)"
      R"(<Advance name="arm" step="0.01"/></Parallel></BehaviorTree></root>)",
      {"--rate", "1000"});
  it.tick_at_most("800");
  const Outcome outcome = run(it.call);
  INFO(outcome.err);
  CHECK(outcome.code == 124);
  CHECK(contains(outcome.err, "Main/Parallel/arm: success"));
  CHECK(contains(outcome.err, "Main/Parallel/bad: warning: its program is late"));
  CHECK(it.are_all_gone());
}

TEST_CASE("time in which lockstep is stopped counts for no limit of a program") {
  const std::string plugin = R"(<root lockstep="1"><plugin name="hostile" program="hostile.py"/>)";
  const std::string leaf = R"(<Misbehave name="bad" how="nothing wrong"/>)";
  const std::string begin = plugin + R"(<BehaviorTree ID="Main">)";
  const std::string end = "</BehaviorTree></root>";
  const std::string runs = begin + leaf + end;
  const std::string halts = begin + R"(<Fallback memory="true"><Timeout seconds="0.1">)" + leaf +
                            R"(</Timeout><Wait seconds="0.2"/></Fallback>)" + end;
  struct Case {
    const char *at, *clock;
    const std::string& tree;
    int code;
  };
  const Case cases[] = {
      {"hello", "virtual", runs, 124}, {"create", "virtual", runs, 124},
      {"tick", "virtual", runs, 124},  {"tick", "wall", runs, 124},
      {"halt", "virtual", halts, 0},   {"halt", "wall", halts, 0},
      {"halt", "wall", runs, 124},     {"end", "virtual", runs, 124},
      {"end", "wall", runs, 124},
  };
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr int kLimit = 4;  // in which a program must also have begun
#else
  constexpr int kLimit = 1;
#endif
  const std::string limit = std::to_string(kLimit);
  std::deque<ProgramRun> programs;
  std::deque<Process> processes;
  for (const Case& it : cases) {
    ProgramRun& run =
        programs.emplace_back(it.tree, std::vector<std::string>{"--clock", it.clock, "--hang-limit",
                                                                limit, "--halt-limit", limit});
    run.call.environment["STOPS_AT"] = it.at;
    processes.emplace_back(run.call).wait_for_stop();
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(1200) * kLimit);
  for (const Process& process : processes) process.signal(SIGCONT);
  run_lockstep({"--version"});  // the programs go on a moment later
  for (std::size_t i = 0; i < std::size(cases); ++i) {
    for (const pid_t program : programs[i].processes()) kill(program, SIGCONT);
    const Outcome outcome = processes[i].finish();
    INFO(cases[i].at << " on the " << cases[i].clock << " clock\n" << outcome.err);
    CHECK(outcome.code == cases[i].code);
    CHECK_FALSE(contains(outcome.err, "its program did not"));
  }
}

TEST_CASE("held by a signal, the process of a leaf is stopped, until it is halted") {
  ProgramRun it(
      R"(<root lockstep="1"><plugin name="steady" program="steady.py" hold="signal"/>)"
      R"(<plugin name="motion"/><BehaviorTree ID="Main"><ParallelAbsolute barriers="0.005">)"
      R"(<Steady name="steady"/><Advance name="arm" step="1e-9"/></ParallelAbsolute>)"
      R"(</BehaviorTree></root>)",
      {"--timeout", "100"});
  it.tick_at_most("100000");
  for (const int end : {SIGINT, SIGKILL}) {
    Process process(it.call);
    REQUIRE(process.wait_for("steady: waits for arm at barrier"));
    const pid_t program = it.processes().back();
    CHECK(becomes_true([&] { return state_of(program).first == 'T'; }));
    process.signal(end);
    const Outcome outcome = process.finish();
    INFO(outcome.err);
    CHECK(outcome.code == 128 + end);
    CHECK(contains(outcome.err, "steady: info: halted") == (end == SIGINT));
    CHECK(it.are_all_gone());
  }
}

TEST_CASE("nothing that a program has started outlives lockstep, not even a kill -9 of it") {
  ProgramRun it(misbehaving("children"), {"--timeout", "100"});
  it.tick_at_most("100000");
  Process process(it.call);
  REQUIRE(process.wait_for("children are there"));
  REQUIRE(it.processes().size() == 4);
  process.signal(SIGKILL);
  process.finish();
  CHECK(it.are_all_gone());
}

TEST_CASE(
    "a program whose guardian is killed dies with all that it has started, which is a fault") {
  ProgramRun it(misbehaving("children"), {"--timeout", "100"});
  it.tick_at_most("100000");
  Process process(it.call);
  REQUIRE(process.wait_for("children are there"));
  const auto all = it.processes();
  kill(state_of(all.front()).second, SIGKILL);
  CHECK(process.wait_for("its guardian has died"));
  CHECK(process.finish().code == 5);
  CHECK(it.are_all_gone());
}

namespace {

// The program is held from the second tick on, until the arm has come to 0.5.
ProgramRun held_program(const std::string& how, const char* step, const std::string& attributes,
                        const std::vector<std::string>& more) {
  return {
      R"(<root lockstep="1"><plugin name="held" program="held.py")" + attributes +
          R"(/><plugin name="motion"/><BehaviorTree ID="Main"><ParallelAbsolute barriers="0.5">)"
          R"(<Held name="bad" how=")" +
          how + R"("/><Advance name="arm" step=")" + step +
          R"("/></ParallelAbsolute></BehaviorTree></root>)",
      more};
}

struct HeldMisdeed {
  const char* how;
  const char* answers;  // it answers pause
  const char* fault;
};

constexpr HeldMisdeed kHeldMisdeeds[] = {
    {"end", "0", "its program ended with exit code 3"},
    {"end", "1", "its program ended with exit code 3 when it was to answer pause of"},
    {"error", "0", "the brake is broken"},
    {"error", "1", "the brake is broken"},
};

}  // namespace

TEST_CASE("a program that dies or fails in pause is a fault at once, however long it is held") {
  for (const HeldMisdeed& row : kHeldMisdeeds) {
    ProgramRun it = held_program(row.how, "1e-9", "", {"--timeout", "30"});
    it.tick_at_most("100000");
    it.call.environment["ANSWERS"] = row.answers;
    const Outcome outcome = run(it.call);
    INFO(row.how << row.answers << "\n" << outcome.err);
    CHECK(outcome.code == 5);
    CHECK(contains(outcome.err, "the leaf 'Main/ParallelAbsolute/bad'"));
    CHECK(contains(outcome.err, row.fault));
    CHECK(it.are_all_gone());
  }
}

TEST_CASE("on the virtual clock the end of a held program is the same in every run") {
  for (const HeldMisdeed& row : kHeldMisdeeds) {
    std::string first;
    for (int i = 0; i < 4; ++i) {
      ProgramRun it = held_program(row.how, "0.05", "", {"--clock", "virtual"});
      const std::string recording = it.directory.path("run.jsonl");
      it.call.arguments.insert(it.call.arguments.end(), {"--record", recording, "--seed", "1"});
      it.call.environment["ANSWERS"] = row.answers;
      const Outcome outcome = run(it.call);
      INFO(row.how << row.answers << "\n" << outcome.err);
      CHECK(outcome.code == 5);
      // In the tick that holds it, if it answers; else in that which asks it something.
      const bool answers = std::string_view(row.answers) == "1";
      CHECK(contains(outcome.err, answers ? "failed in tick 1 " : "failed in tick 10 "));
      CHECK(contains(outcome.err, row.fault));
      const std::string text = read_file(recording);
      const std::string ticks = text.substr(text.find('\n'));  // the first line names the file
      CHECK(ticks == (i == 0 ? first = ticks : first));
    }
  }
}

TEST_CASE("a program that does not answer pause is late, and is killed after the hang limit") {
  for (const char* clock : {"wall", "virtual"}) {
    ProgramRun it = held_program("silent", "1e-9", "", {"--timeout", "30", "--clock", clock});
    it.call.arguments.insert(it.call.arguments.end(), {"--hang-limit", "2"});
    it.tick_at_most("100000");
    it.call.environment["ANSWERS"] = "1";
    const Outcome outcome = run(it.call);
    INFO(clock << "\n" << outcome.err);
    CHECK(outcome.code == 5);
    CHECK(contains(outcome.err, "its program did not answer"));
    const bool is_late = contains(outcome.err, "bad: warning: its program is late");
    CHECK(is_late == (std::string_view(clock) == "wall"));
  }
}

TEST_CASE("a held program that is killed, or whose guardian is, is a fault as soon as it happens") {
  for (const char* hold : {"", R"( hold="signal")", R"( hold="none")"}) {
    for (const bool is_guardian : {false, true}) {
      ProgramRun it = held_program("still", "1e-9", hold, {"--timeout", "30"});
      it.tick_at_most("100000");
      Process process(it.call);
      REQUIRE(process.wait_for("bad: waits for arm at barrier"));
      const pid_t program = it.processes().back();
      kill(is_guardian ? state_of(program).second : program, SIGKILL);
      const Outcome outcome = process.finish();
      INFO(hold << "\n" << outcome.err);
      CHECK(outcome.code == 5);
      CHECK(contains(outcome.err, is_guardian ? "its program was killed: its guardian has died"
                                              : "its program was killed by SIGKILL (Killed)"));
      CHECK(it.are_all_gone());
    }
  }
}

TEST_CASE("a held program that dies is a failure of its leaf, if the run goes on after faults") {
  ProgramRun it(
      R"(<root lockstep="1"><plugin name="held" program="held.py"/><plugin name="motion"/>)"
      R"(<BehaviorTree ID="Main"><ParallelAbsolute barriers="0.5"><Sequence memory="true">)"
      R"(<AlwaysSuccess/><AlwaysSuccess/><Held name="bad" how="end"/></Sequence>)"
      R"(<Advance name="arm" step="1e-9"/></ParallelAbsolute></BehaviorTree></root>)",
      {"--timeout", "30", "--on-fault", "fail"});
  it.tick_at_most("100000");
  const Outcome outcome = run(it.call);
  INFO(outcome.err);
  CHECK(outcome.code == 1);
  CHECK(contains(outcome.err, "its program ended with exit code 3"));
  CHECK(contains(outcome.err, "arm: halted"));
}

TEST_CASE("a leaf that dies while it is held has not fallen back: its Failure changes no measure") {
  const TemporaryDirectory directory;
  std::filesystem::copy_file(LOCKSTEP_BINARY_DIR "/plugins/motion.so", directory.path("motion.so"));
  const std::string advance = R"(<Advance name="bad" step="0.6"/>)";
  const std::string held = R"(<Held name="bad" how="still"/>)";
  const std::string motion = R"(<plugin name="motion" isolate="true"/>)";
  const std::string program = R"(<plugin name="held" program="held.py")";
  struct Case {
    std::string plugins, leaf;
  };
  const Case cases[] = {{motion, advance},
                        {motion, "<ForceFailure>" + advance + "</ForceFailure>"},
                        {program + "/>", held},
                        {program + R"( hold="signal"/>)", held}};
  for (const Case& row : cases) {
    ProgramRun it(R"(<root lockstep="1">)" + row.plugins +
                      R"(<plugin name="steady" program="steady.py"/>)"
                      R"(<BehaviorTree ID="Main"><Fallback><ParallelAbsolute barriers="0.5">)" +
                      row.leaf +
                      R"(<Steady/></ParallelAbsolute><AlwaysSuccess/></Fallback>)"
                      R"(</BehaviorTree></root>)",
                  {"--timeout", "30", "--on-fault", "fail", "--plugin-path", directory.path("")});
    it.tick_at_most("100000");
    Process process(it.call);
    REQUIRE(process.wait_for(": waits for Steady at barrier"));
    const bool is_isolated = row.plugins == motion;
    const pid_t held_one =
        is_isolated ? processes_with(directory.path("motion.so")).back() : it.processes().front();
    kill(held_one, SIGKILL);
    const Outcome outcome = process.finish();
    INFO(row.plugins << row.leaf << "\n" << outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err, "killed by SIGKILL"));
    CHECK(contains(outcome.out, "(bound "));
    CHECK_FALSE(contains(outcome.out, "fell"));
  }
}

TEST_CASE("a program that has died is reaped while the run goes on") {
  ProgramRun it(
      R"(<root lockstep="1"><plugin name="hostile" program="hostile.py"/><plugin name="motion"/>)"
      R"(<BehaviorTree ID="Main"><Parallel><Advance name="arm" step="1e-9"/>)"
      R"(<Fallback><Misbehave name="bad" how="die"/><AlwaysSuccess/></Fallback></Parallel></BehaviorTree></root>)",
      {"--timeout", "100", "--on-fault", "fail"});
  it.tick_at_most("100000");
  Process process(it.call);
  REQUIRE(process.wait_for("was killed by SIGSEGV"));
  CHECK(it.are_all_gone());
  CHECK(process.end_by(SIGINT).code == 130);
}

TEST_CASE("a program that floods its output does not keep the run from ending, and is named") {
  for (const char* clock : {"virtual", "wall"}) {
    ProgramRun it(misbehaving("nothing wrong"), {"--clock", clock, "--halt-limit", "1", "--json"});
    it.call.environment["FLOOD"] = "1";
    const Outcome outcome = run(it.call);
    INFO(clock << "\n" << outcome.err.substr(0, 2000));
    CHECK(outcome.code == 124);
    CHECK(contains(outcome.out,
                   "the end of the run took longer than --halt-limit (1 s): it waited for "));
    CHECK(contains(outcome.out, "the program 'hostile'"));
    CHECK(contains(outcome.err, "its program did not end for 1 s after its input was closed"));
    CHECK(it.are_all_gone());
  }
}

TEST_CASE("programs that do not end are ended together") {
  // Three processes of one program, and one of another.
  ProgramRun it(R"(<root lockstep="1"><plugin name="hostile" program="hostile.py" hold="signal"/>)"
                R"(<plugin name="steady" program="steady.py"/><BehaviorTree ID="Main"><Parallel>)"
                R"(<Misbehave how=""/><Misbehave how=""/><Misbehave how=""/><Steady/></Parallel>)"
                R"(</BehaviorTree></root>)",
                {"--clock", "virtual", "--halt-limit", "1"});
  it.call.environment["STUBBORN"] = "1";
  Process process(it.call);
  REQUIRE(process.wait_for("Steady: halted"));  // the programs began one after the other
  const auto began = std::chrono::steady_clock::now();
  const Outcome outcome = process.finish();
  INFO(outcome.err);
  CHECK(outcome.code == 124);
  CHECK(contains(outcome.err, "its program did not end for 1 s"));
  // To the end of their input, and to KILL after TERM: one limit each, not one for each process.
  CHECK(std::chrono::steady_clock::now() - began < std::chrono::seconds(6));
  CHECK(it.are_all_gone());
}

TEST_CASE(
    "a program that does not answer halt gets TERM, then KILL, as does one that does not end") {
  for (const char* clock : {"virtual", "wall"}) {
    for (const char* how : {"deaf", "steady"}) {
      ProgramRun it(misbehaving(how), {"--clock", clock, "--halt-limit", "0.5"});
      it.call.environment["STUBBORN"] = "1";
      const Outcome outcome = run(it.call);
      INFO(clock << " " << how << "\n" << outcome.err);
      const bool is_deaf = std::string_view(how) == "deaf";
      CHECK(outcome.code == (is_deaf ? 5 : 124));
      CHECK(contains(outcome.err,
                     is_deaf ? "its program did not answer halt of 'Main/Parallel/bad' for "
                               "0.5 s; it was ended"
                             : "its program did not end for 0.5 s after its input was "
                               "closed; it was ended"));
      CHECK(it.are_all_gone());
    }
  }
}

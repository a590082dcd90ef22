// The live view on a terminal: what it shows, its keys, and the terminal as it was in the end.
#include <catch2/catch.hpp>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

// `count` stages of twelve children each, of which one runs at a time, for ever.
std::string stages(int count) {
  std::string text = "<Sequence memory=\"true\">";
  for (int stage = 0; stage < count; ++stage) {
    text += "<ParallelAbsolute barriers=\"0.5\" name=\"stage" + std::to_string(stage) + "\">";
    for (int child = 0; child < 12; ++child) {
      text += "<Advance name=\"joint" + std::to_string(child) +
              (stage == count / 2 ? "\" step=\"0\"/>" : "\" step=\"1\"/>");
    }
    text += "</ParallelAbsolute>";
  }
  return tree_text(text + "</Sequence>");
}

const std::string kEndless = tree_text("<Parallel><Advance name=\"arm\" step=\"0\"/></Parallel>");

// The run of a tree on a terminal of 40 rows and 120 columns, without colors.
struct Live {
  explicit Live(const std::string& tree, std::vector<std::string> more = {},
                std::map<std::string, std::string> environment = {})
      : process(call(directory.file("tree.xml", tree), std::move(more), std::move(environment)),
                Process::Output::Terminal) {}

  static Invocation call(const std::string& file, std::vector<std::string> more,
                         std::map<std::string, std::string> environment) {
    environment.insert({"NO_COLOR", "1"});
    std::vector<std::string> arguments{"run", file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return {.arguments = arguments, .environment = environment};
  }

  void expect(const std::string& keys, const std::string& text) {
    process.clear_output();
    process.type(keys);
    CAPTURE(keys, text);
    REQUIRE(process.wait_for(text));
  }

  TemporaryDirectory directory;
  Process process;
};

}  // namespace

TEST_CASE("a tree that does not fit the terminal: the live view shows the stage that runs") {
  Live live(stages(20));
  REQUIRE(live.process.wait_for("> stage10"));
  live.process.clear_output();
  REQUIRE(live.process.wait_for("> stage10"));  // a whole frame
  REQUIRE(live.process.wait_for("nodes left out: "));
  const Outcome outcome = live.process.end_by(SIGINT);
  CHECK(outcome.code == 130);
  for (int joint = 0; joint < 12; ++joint) {
    CHECK(contains(outcome.out, "    > joint" + std::to_string(joint)));
  }
  CHECK(contains(outcome.out, "  + stage9 (ParallelAbsolute)"));
  CHECK(contains(outcome.out, "  - stage11 (ParallelAbsolute)"));
  CHECK(!outcome.terminal_is_raw);
}

TEST_CASE("keys scroll and fold the live view, and let it follow what runs again") {
  Live live(stages(20));
  REQUIRE(live.process.wait_for("> stage10"));  // the cursor begins at what runs
  REQUIRE(live.process.wait_for("up down scroll"));
  live.expect("\x1b[B", "*   > joint0");
  live.expect("\x1b[B", "*   > joint1");
  live.expect("\x1b[A", "*   > joint0");
  live.expect("f", "* > stage10 (ParallelAbsolute)  + 12 nodes: 12 running");
  live.expect("f", "    > joint0");
  live.expect("\x1b[6~", "rows 151 to 187 of 261");
  live.expect("\x1b", "nodes left out: ");
  const Outcome outcome = live.process.end_by(SIGTERM);
  CHECK(outcome.code == 143);
  CHECK(!outcome.terminal_is_raw);
}

TEST_CASE("however a run ends, the terminal is as it was") {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGSEGV, SIGABRT}) {
    Live live(kEndless);
    REQUIRE(live.process.wait_for("> arm"));
    const Outcome outcome = live.process.end_by(number);
    CAPTURE(number, outcome.out);
    // A crash has an exit code of its own.
    CHECK(outcome.code == (number == SIGSEGV || number == SIGABRT ? 6 : 128 + number));
    CHECK(!outcome.terminal_is_raw);
    CHECK(outcome.out.rfind("\x1b[?25h") > outcome.out.rfind("\x1b[?25l"));
  }
  Live live(kEndless);
  REQUIRE(live.process.wait_for("> arm"));
  live.process.type("\x03");  // Ctrl-C
  const Outcome outcome = live.process.finish();
  CHECK(outcome.code == 130);
  CHECK(!outcome.terminal_is_raw);
}

TEST_CASE("a leaf that stops the program, or never returns, leaves the terminal as it was") {
  const std::string tree =
      "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><Probe/></BehaviorTree></root>";
  Live live(tree, {"--plugin", LOCKSTEP_BINARY_DIR "/tests/cli/stuck.so", "--hang-limit", "0.2"});
  const Outcome outcome = live.process.finish();
  CHECK(outcome.code == 6);
  CHECK(!outcome.terminal_is_raw);
  CHECK(outcome.out.rfind("\x1b[?25h") > outcome.out.rfind("\x1b[?25l"));
}

// dash, which leaves the modes of the terminal to its jobs.
TEST_CASE("Ctrl-Z gives the terminal back, fg draws the view again") {
  const TemporaryDirectory directory;
  const std::string program = LOCKSTEP_BINARY_DIR "/lockstep ";
  const std::string file = directory.path("run.jsonl");
  const std::string run = program + "run " + directory.file("tree.xml", kEndless);
  REQUIRE(run_lockstep({"run", directory.path("tree.xml"), "--clock", "virtual", "--max-ticks",
                        "100", "--view", "none", "--record", file})
              .code == 124);
  for (const std::string& command : {run, program + "replay --speed 0.001 " + file}) {
    CAPTURE(command);
    Process shell({.arguments = {"-i"},
                   .environment = {{"NO_COLOR", "1"}, {"PS1", "$ "}},
                   .program = "/bin/sh"},
                  Process::Output::Terminal);
    const auto expect = [&shell](const std::string& keys, const std::string& text) {
      shell.clear_output();
      shell.type(keys);
      CAPTURE(keys, text);
      REQUIRE(shell.wait_for(text));
    };
    expect(command + "\n", "> arm");
    expect("\x1a", "\x1b[?25h");
    REQUIRE(shell.wait_for("Stopped"));
    expect("stty -a\n", " icanon ");
    REQUIRE(shell.wait_for(" echo "));
    expect("fg\n", "\x1b[?25l");
    REQUIRE(shell.wait_for("> arm"));
    expect("\x1b[B", "*   > arm");  // its keys are back
    expect("\x1a", "Stopped");
    expect("bg\n", "[1] ");
    expect("jobs\n", "Running");  // a program that reads the keys there is stopped
    expect("fg\n", "\x1b[?25l");
    REQUIRE(shell.wait_for("> arm"));
    expect("\x1b[A", "* > Parallel");  // still, though the shell has read lines meanwhile
    expect("\x03", "\x1b[?25h");
    shell.type("exit\n");
    CHECK(!shell.finish().terminal_is_raw);
  }
}

TEST_CASE("a terminal that cannot draw gets plain lines") {
  const std::string tree = tree_text("<Advance step=\"0.5\"/>");
  for (const std::string view : {"auto", "live"}) {
    Live live(tree, {"--view", view}, {{"TERM", "dumb"}});
    const Outcome outcome = live.process.finish();
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out, "Main/Advance: started"));
    CHECK(!contains(outcome.out, "\x1b"));
  }
}

TEST_CASE("after it was stopped and continued, the live view draws everything again") {
  Live live(kEndless);
  REQUIRE(live.process.wait_for("> arm"));
  live.process.signal(SIGSTOP);
  live.process.clear_output();
  live.process.signal(SIGCONT);
  REQUIRE(live.process.wait_for("\x1b[?25l"));
  live.process.clear_output();
  REQUIRE(live.process.wait_for("> arm"));
  CHECK(live.process.end_by(SIGINT).code == 130);
}

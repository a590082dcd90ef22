#include <catch2/catch.hpp>

#include "support/program.h"

using namespace lockstep::host::test;

namespace {

// Types keys, and waits for what the terminal shows then.
auto keys_of(Process& process) {
  return [&process](const std::string& keys, const std::string& text) {
    process.clear_output();
    process.type(keys);
    CAPTURE(keys, text);
    REQUIRE(process.wait_for(text));
  };
}

Outcome call(std::vector<std::string> arguments) {
  return run_lockstep(std::move(arguments));
}

const std::string kReplayTree = tree_text(
    "<ParallelAbsolute name=\"pull\" barriers=\"0.5;1\">"
    "<Advance name=\"arm\" step=\"0.25\"/><Advance name=\"base\" step=\"0.5\"/>"
    "</ParallelAbsolute>");

std::string record_tree(const TemporaryDirectory& directory, const std::string& tree = kReplayTree,
                        const std::string& ticks = "100") {
  const std::string file = directory.path("run.jsonl");
  const Outcome outcome =
      call({"run", directory.file("tree.xml", tree), "--clock", "virtual", "--rate", "10",
            "--max-ticks", ticks, "--view", "none", "--record", file});
  REQUIRE((outcome.code == 0 || outcome.code == 124));
  return file;
}

std::string with_replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

constexpr const char* kTick1 =
    "Main  10 Hz (virtual)  tick 1  0.100 s\n"
    "> pull (ParallelAbsolute)\n"
    "  > arm  [##########..........|...................] 0.25\n"
    "  = base [####################|...................] 0.50  waits for arm at barrier 0.5\n";

}  // namespace

TEST_CASE("a replay shows which round of Retry and Repeat it is") {
  const TemporaryDirectory directory;
  const std::string file = record_tree(
      directory,
      tree_text("<Parallel><ForceSuccess><Retry attempts=\"8\"><Inverter><Advance step=\"0.5\"/>"
                "</Inverter></Retry></ForceSuccess><Repeat><Advance step=\"0.4\"/></Repeat>"
                "</Parallel>"),
      "30");
  const auto shown = [&](const std::string& tick) {
    return call({"replay", file, "--at", tick}).out;
  };
  CHECK(contains(shown("0"), "> Retry  1/8\n"));
  CHECK(contains(shown("4"), "> Retry  3/8\n"));
  CHECK(contains(shown("4"), "> Repeat  2\n"));
  CHECK_FALSE(contains(shown("20"), "/8"));
}

TEST_CASE("without a terminal a replay prints one tick: that of --at, else the last") {
  const TemporaryDirectory directory;
  const std::string file = record_tree(directory);
  const Outcome at = call({"replay", file, "--at", "1"});
  CHECK(at.code == 0);
  CHECK(at.out == kTick1);
  CHECK(at.err == "");
  const Outcome last = call({"replay", file});
  CHECK(last.code == 0);
  CHECK(last.out.starts_with("Main  10 Hz (virtual)  tick 3  0.300 s  success\n+ pull"));
  const Outcome piped = run({.arguments = {"replay", "-", "--at", "1"}, .input = read_file(file)});
  CHECK(piped.out == kTick1);
  const Outcome beyond = call({"replay", file, "--at", "4"});
  CHECK(beyond.code == 2);
  CHECK(beyond.err == "lockstep: error: --at 4: the recording has ticks 0 to 3\n");
  CHECK(beyond.out == "");
  for (const char* bad : {"-1", "1.5", "x", "18446744073709551616"})
    CHECK(call({"replay", file, "--at", bad}).code == 2);
  for (const char* bad : {"0", "-1", "x", "nan"}) {
    CHECK(call({"replay", file, "--speed", bad}).code == 2);
  }
}

TEST_CASE("one tick of a replay has the entries that were written before it") {
  const TemporaryDirectory directory;
  const std::string file = record_tree(
      directory,
      tree_text("<Sequence memory=\"true\"><Script code=\"x := 5\"/><Advance step=\"0.25\"/>"
                "<Script code=\"x = 6\"/><Advance step=\"0.25\"/></Sequence>"),
      "30");
  const auto shown = [&](const std::string& tick) {
    return call({"replay", file, "--at", tick}).out;
  };
  CHECK(contains(shown("0"), "\nx = 5\n"));
  CHECK(contains(shown("1"), "\nx = 5\n"));
  CHECK(contains(shown("5"), "\nx = 6\n"));
}

TEST_CASE("a replay of what is cut, damaged or has gaps shows what is there") {
  const TemporaryDirectory directory;
  const std::string text = read_file(record_tree(directory));
  const std::string cut = directory.file("cut.jsonl", text.substr(0, text.find("{\"tick\":2") + 9));
  const Outcome of_cut = call({"replay", cut});
  CHECK(of_cut.code == 0);
  CHECK(of_cut.out == kTick1);
  CHECK(contains(of_cut.err, "the recording is cut: line 4 is cut"));
  const std::string damaged =
      directory.file("damaged.jsonl", with_replaced(text, "{\"tick\":2", "{tick:2"));
  const Outcome of_damaged = call({"replay", damaged});
  CHECK(of_damaged.code == 3);
  CHECK(of_damaged.out == kTick1);
  CHECK(contains(of_damaged.err, "damaged.jsonl:4: not JSON"));
  const auto tick2 = text.find("{\"tick\":2"), tick3 = text.find("{\"tick\":3");
  const std::string gap =
      directory.file("gap.jsonl", text.substr(0, tick2) + "{\"lost\":{\"ticks\":1,\"from\":2}}\n" +
                                      with_replaced(text.substr(tick3), "}}", ",\"lost\":1}}"));
  const Outcome of_gap = call({"replay", gap, "--at", "2"});
  CHECK(of_gap.code == 0);
  CHECK(of_gap.out == kTick1);
  CHECK(contains(of_gap.err, "1 tick is missing, the first is 2"));
  CHECK(contains(of_gap.err, "tick 2 is not in the recording: 1 is the last before it"));
  const std::string empty = directory.file("empty.jsonl", text.substr(0, text.find('\n') + 1));
  CHECK(call({"replay", empty}).code == 2);
  CHECK(call({"replay", directory.file("none.jsonl", "{}\n")}).code == 3);
  CHECK(call({"replay", directory.path("missing.jsonl")}).code == 2);
}

TEST_CASE("keys on a terminal: steps, jumps, the end, and the terminal as it was") {
  const TemporaryDirectory directory;
  const std::string file = record_tree(directory, kReplayTree);
  // Slow enough that it stays where the keys put it.
  Process process({.arguments = {"replay", file, "--speed", "0.001"}}, Process::Output::Terminal);
  const auto expect = keys_of(process);
  REQUIRE(process.wait_for("plays\x1b[0m  tick 0 of 3"));
  expect(" ", "paused\x1b[0m  tick 0 of 3");
  expect("n", "tick 1 of 3");
  expect("\x1b[C", "tick 2 of 3");
  expect("\x1b[D", "waits for arm at barrier 0.5");
  expect("p", "tick 0 of 3");
  expect("g2", "go to tick: 2_");
  expect("\r", "tick 2 of 3");
  expect("g77\r", "no tick 77: the recording has 0 to 3");
  expect("\x1b[H", "tick 0 of 3");
  expect("\x1b[F", "tick 3 of 3");
  expect("+", "speed 0.002");
  expect("-", "speed 0.001");
  process.type("q");
  const Outcome outcome = process.finish();
  CHECK(outcome.code == 0);
  CHECK(!outcome.terminal_is_raw);
  CHECK(contains(outcome.out, "\x1b[?25h"));
}

TEST_CASE(
    "keys scroll and fold a replay as the live view, and a number that is typed comes first") {
  const TemporaryDirectory directory;
  const std::string file = record_tree(directory, kReplayTree);
  Process process(
      {.arguments = {"replay", file, "--speed", "0.001"}, .environment = {{"NO_COLOR", "1"}}},
      Process::Output::Terminal);
  const auto expect = keys_of(process);
  REQUIRE(process.wait_for("plays  tick 0 of 3"));
  expect(" ", "paused");
  expect("\x1b[B", "*   > arm");
  expect("\x1b[B", "*   > base");
  expect("f", "* > pull (ParallelAbsolute)  + 2 nodes: 2 running");
  expect("F", "    > arm");
  expect("g2", "go to tick: 2_");
  expect("\r", "tick 2 of 3");
  process.type("q");
  CHECK(process.finish().code == 0);
}

TEST_CASE("without a terminal that can draw a replay prints one tick") {
  const TemporaryDirectory directory;
  const Outcome outcome = Process({.arguments = {"replay", record_tree(directory), "--at", "1"},
                                   .environment = {{"TERM", "dumb"}}},
                                  Process::Output::Terminal)
                              .finish();
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "tick 1  0.100 s\r\n"));
  CHECK(!contains(outcome.out, "\x1b"));
}

TEST_CASE("a replay of a part has the ticks from --from to --to") {
  const TemporaryDirectory directory;
  const std::string file = record_tree(directory, kReplayTree);
  Process process({.arguments = {"replay", file, "--from", "1", "--to", "2", "--speed", "0.001"},
                   .environment = {{"NO_COLOR", "1"}}},
                  Process::Output::Terminal);
  const auto expect = keys_of(process);
  REQUIRE(process.wait_for("plays  tick 1 of 2"));
  expect(" ", "waits for arm at barrier 0.5");
  expect("n", "tick 2 of 2");
  expect("\x1b[H", "tick 1 of 2");
  expect("g0\r", "no tick 0: the recording has 1 to 2");
  process.type("q");
  CHECK(process.finish().code == 0);
  const Outcome behind =
      Process({.arguments = {"replay", file, "--from", "77"}}, Process::Output::Terminal).finish();
  CHECK(behind.code == 2);
  CHECK(contains(behind.out, "--from 77"));
  const Outcome printed = call({"replay", file, "--from", "1"});
  CHECK(printed.code == 2);
  CHECK(contains(printed.err, "--at prints one tick"));
}

TEST_CASE("a replay is drawn anew when the window gets another size, also while it is paused") {
  const TemporaryDirectory directory;
  const std::string file = record_tree(directory, kReplayTree);
  Process process(
      {.arguments = {"replay", file, "--speed", "0.001"}, .environment = {{"NO_COLOR", "1"}}},
      Process::Output::Terminal);
  REQUIRE(process.wait_for("plays  tick 0 of 3"));
  process.type(" ");
  REQUIRE(process.wait_for("paused  tick 0 of 3"));
  const auto redrawn = [&](unsigned short rows, unsigned short columns) {
    process.clear_output();
    process.resize(rows, columns);
    REQUIRE(process.wait_for("\x1b[H\x1b[2J"));
    REQUIRE(process.wait_for("q quit"));
    process.clear_output();
  };
  redrawn(40, 200);  // everything had its place before
  redrawn(40, 90);
  process.resize(40, 30);  // the keys do not fit any more
  REQUIRE(process.wait_for("\x1b[H\x1b[2J"));
  REQUIRE(process.wait_for("space continue"));
  process.type("n");
  REQUIRE(process.wait_for("tick 1 of 3"));
  process.type("q");
  const Outcome outcome = process.finish();
  CHECK(outcome.code == 0);
  CHECK(!contains(outcome.out, "q quit"));
  CHECK(!outcome.terminal_is_raw);
}

TEST_CASE("a replay plays by itself to the end") {
  const TemporaryDirectory directory;
  Process process({.arguments = {"replay", record_tree(directory), "--speed", "1000"}},
                  Process::Output::Terminal);
  REQUIRE(process.wait_for("end\x1b[0m  tick 3 of 3"));
  process.type("q");
  CHECK(process.finish().code == 0);
}

TEST_CASE("however a replay ends, the terminal is as it was") {
  const TemporaryDirectory directory;
  const std::string file = record_tree(directory);
  for (const int number :
       {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGALRM, SIGXCPU, SIGSEGV, SIGABRT}) {
    Process process({.arguments = {"replay", file, "--speed", "0.001"}}, Process::Output::Terminal);
    REQUIRE(process.wait_for("tick 0 of 3"));
    const Outcome outcome = process.end_by(number);
    CAPTURE(number);
    CHECK(outcome.code == (number == SIGSEGV || number == SIGABRT ? 6 : 128 + number));
    CHECK(!outcome.terminal_is_raw);
    CHECK(outcome.out.rfind("\x1b[?25h") > outcome.out.rfind("\x1b[?25l"));
  }
  Process process({.arguments = {"replay", file, "--speed", "0.001"}}, Process::Output::Terminal);
  REQUIRE(process.wait_for("tick 0 of 3"));
  process.type("\x03");  // Ctrl-C
  const Outcome outcome = process.finish();
  CHECK(outcome.code == 130);
  CHECK(!outcome.terminal_is_raw);
}

TEST_CASE("replay --print prints on a terminal too") {
  const TemporaryDirectory directory;
  const Outcome outcome =
      Process({.arguments = {"replay", record_tree(directory), "--at", "1", "--print"},
               .environment = {{"NO_COLOR", "1"}}},
              Process::Output::Terminal)
          .finish();
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "tick 1  0.100 s\r\n"));
  CHECK(!contains(outcome.out, "\x1b"));
}

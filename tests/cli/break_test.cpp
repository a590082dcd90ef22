// A run that pauses at breakpoints, and commands on stdin: `run --break`.
#include <catch2/catch.hpp>

#include "support/program.h"

using namespace lockstep::host::test;

namespace {

constexpr const char* kRun = "lockstep run tree.xml --clock virtual --view none ";

TemporaryDirectory with_carrying_tree() {
  TemporaryDirectory directory;
  directory.file("tree.xml",
                 "<root lockstep=\"1\"><plugin name=\"motion\"/><BehaviorTree ID=\"Main\">"
                 "<Sequence memory=\"true\"><Script code=\"force := 2\"/>"
                 "<ParallelAbsolute name=\"carry\" barriers=\"0.5\">"
                 "<Advance name=\"arm\" step=\"0.1\"/><Advance name=\"base\" step=\"0.25\"/>"
                 "</ParallelAbsolute><Check name=\"strong\" code=\"force &gt;= 5\"/></Sequence>"
                 "</BehaviorTree></root>");
  return directory;
}

Outcome typed(const TemporaryDirectory& directory, const std::string& lines,
              const std::string& options) {
  return shell("printf '" + lines + "' | " + kRun + options, directory);
}

}  // namespace

TEST_CASE("a breakpoint pauses a run, which then does what is typed") {
  const TemporaryDirectory directory = with_carrying_tree();
  const Outcome run =
      typed(directory, "p\\ns\\n\\nset force 7\\nc\\nc\\n", "--break carry --break strong:success");
  INFO(run.err);
  CHECK(run.code == 0);
  CHECK(contains(run.err, "paused after tick 0 (0.000 s): 'Main/Sequence/carry' began\n"));
  CHECK(contains(run.err, "        arm (Advance): running\n"));
  CHECK(contains(run.err, "  force = 2\n"));
  CHECK(contains(run.err, "paused after tick 1 (0.010 s)\n"));
  CHECK(contains(run.err, "paused after tick 2 (0.020 s)\n"));
  CHECK(contains(run.err, "base (Advance): running, held\n"));
  CHECK(
      contains(run.err, "the run ends after tick 9 (0.090 s): 'Main/Sequence/strong' succeeded\n"));
  CHECK(contains(run.out, "success after 10 ticks"));
}

TEST_CASE("breakpoints of results and barriers, and those that are typed") {
  const TemporaryDirectory directory = with_carrying_tree();
  CHECK(contains(typed(directory, "c\\n", "--break strong:failure").err,
                 "'Main/Sequence/strong' failed\n"));
  CHECK(contains(typed(directory, "c\\nc\\n", "--break carry:barrier").err,
                 "paused after tick 2 (0.020 s): 'Main/Sequence/carry' came to its limit\n"));
  const Outcome more =
      typed(directory, "b base:after\\nd carry\\nb nobody\\nhelp\\nc\\nc\\n", "--break carry");
  INFO(more.err);
  CHECK(
      contains(more.err, "paused after tick 6 (0.060 s): 'Main/Sequence/carry/base' completed\n"));
  CHECK(contains(more.err, "no node 'nobody'"));
  CHECK(contains(more.err, "'help' is not a command\n"));
  const Outcome quit = typed(directory, "q\\n", "--break arm");
  CHECK(contains(quit.out, "stopped"));
  CHECK(contains(quit.out, " after 1 tick"));
}

TEST_CASE("a run that ends where it is paused, or would pause, tells no pause for that") {
  const TemporaryDirectory directory = with_carrying_tree();
  const auto pauses = [&](const std::string& lines, const std::string& options) {
    const Outcome run = typed(directory, lines, "--break arm " + options);
    INFO(run.err);
    CHECK_FALSE(contains(run.err, "the run continues"));
    std::size_t count = 0;
    for (auto at = run.err.find("paused "); at != run.err.npos;
         at = run.err.find("paused ", at + 1))
      ++count;
    return count;
  };
  CHECK(pauses("q\\n", "") == 1);
  CHECK(pauses("s\\nq\\n", "") == 2);
  CHECK(pauses("c\\n", "--max-ticks 1") == 0);
}

TEST_CASE("run --break-if pauses a run after each tick in which a condition becomes true") {
  const TemporaryDirectory directory = with_carrying_tree();
  const Outcome run = typed(directory, "s\\nset force 7\\nc\\nc\\nc\\n",
                            "--break-if 'arm.progress >= 0.3' --break-if '{force} > 5'");
  INFO(run.err);
  CHECK(run.code == 0);
  const auto at = run.err.find("paused after tick ");
  REQUIRE(at != std::string::npos);
  CHECK(contains(run.err, "s): arm.progress >= 0.3\n"));
  CHECK(contains(run.err, "s): {force} > 5\n"));
  // Once for each time that it becomes true, and once for the step.
  std::size_t pauses = 0;
  for (std::size_t i = at; i != std::string::npos; i = run.err.find("paused after tick ", i + 1))
    ++pauses;
  CHECK(pauses == 3);
  // The property that it is never true says in which tick it becomes true.
  const Outcome property = shell(
      std::string(kRun) + "--property 'never base.held and arm.progress >= 0.2' --json < /dev/null",
      directory);
  const Outcome held = typed(directory, "c\\n", "--break-if 'base.held and arm.progress >= 0.2'");
  INFO(property.out + property.err);
  const auto tick = held.err.find("paused after tick ") + 18;
  const std::string number = held.err.substr(tick, held.err.find(' ', tick) - tick);
  CHECK(contains(property.err + property.out, "tick " + number));
}

TEST_CASE("run --break-if: the end of the run, both clocks, and what is no condition") {
  const TemporaryDirectory directory = with_carrying_tree();
  CHECK(contains(typed(directory, "c\\n", "--break-if strong.failure").err,
                 "the run ends after tick 9 (0.090 s): strong.failure\n"));
  const Outcome wall =
      shell("printf 'c\\n' | lockstep run tree.xml --view none --break-if 'base.progress >= 0.5'",
            directory);
  const Outcome virtual_clock = typed(directory, "c\\n", "--break-if 'base.progress >= 0.5'");
  const auto tick = [](const std::string& text) {
    const auto at = text.find("paused after tick ");
    return at == std::string::npos ? "none" : text.substr(at, text.find(' ', at + 18) - at);
  };
  INFO(wall.err);
  CHECK(tick(wall.err) != "none");
  CHECK(tick(wall.err) == tick(virtual_clock.err));
  const Outcome wrong = typed(directory, "", "--break-if 'ar.held'");
  CHECK(wrong.code == 2);
  CHECK(contains(wrong.err, "--break-if:1:1: error: "));
  CHECK(typed(directory, "", "--break-if 'arm.running leads to arm.success'").code == 2);
  CHECK(typed(directory, "", "--break-if ''").code == 2);
}

TEST_CASE("breakpoints: when stdin ends, the run continues, and what cannot be is refused") {
  const TemporaryDirectory directory = with_carrying_tree();
  const Outcome ended = typed(directory, "", "--break arm --break arm:after");
  INFO(ended.err);
  CHECK(ended.code == 1);
  CHECK(contains(ended.err, "stdin has ended: the run continues\n"));
  for (const char* stops :
       {"--break arm --break carry:barrier", "--break arm --break-if base.held"}) {
    const std::string err = typed(directory, "", stops).err,
                      two = typed(directory, "c\\n", stops).err;
    INFO(err + two);
    CHECK(err.find("paused after tick") == err.rfind("paused after tick"));
    CHECK(two.find("paused after tick") != two.rfind("paused after tick"));
  }
  CHECK(contains(typed(directory, "", "--break ar").err, "no node 'ar'"));
  CHECK(contains(typed(directory, "", "--break arm:afte").err, "did you mean 'after'?"));
  CHECK(contains(typed(directory, "", "--break arm:barrier").err, "has no barriers and no delta"));
  const Outcome piped = shell("lockstep run - --break arm < tree.xml", directory);
  CHECK(piped.code == 2);
  CHECK(contains(piped.err, "--break reads commands from stdin, which has the tree"));
}

TEST_CASE("breakpoints on the wall clock: a signal ends the run that waits for a command") {
  const TemporaryDirectory directory = with_carrying_tree();
  const Outcome run = shell(
      "mkfifo typed; sleep 30 > typed & timeout --preserve-status -s INT 1 lockstep run tree.xml "
      "--view none --break arm < typed; code=$?; kill %1; exit $code",
      directory);
  INFO(run.err);
  CHECK(run.code == 130);
  CHECK(contains(run.err, "paused after tick 0"));
}

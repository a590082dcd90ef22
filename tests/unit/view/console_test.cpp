// The plain lines, and the thread of the live view.
#include <catch2/catch.hpp>

#include "dialect/btcpp/rules.h"
#include "run/shape_of.h"
#include "show/view/console_live.h"
#include "show/view/console_plain.h"
#include "support/tree_text.h"
#include "unit/recording/watched_run.h"

namespace lockstep::host {
namespace {

using test::TextFile;
using test::WatchedRun;

Nanoseconds frozen() {
  return Nanoseconds(std::chrono::hours(1));
}

std::string plain(std::string_view tree, std::string_view leaves, std::uint64_t max_ticks = 1000,
                  const LanguageRules& rules = kLockstepRules) {
  TextFile out;
  WatchedRun run(test::tree_from_text(tree, rules), leaves);
  ConsolePlain console(shape_of(run.run.tree()), out.outlet(), frozen);
  run.watch({&console}, max_ticks);
  return out.text();
}

TEST_CASE("plain lines tell who waits for whom") {
  CHECK(plain("ParallelAbsolute[barriers=.5;1](a b)", "a+.1 b+.5") ==
        "     0.000 s  tick 0       run of Test starts, 10 Hz, virtual clock\n"
        "     0.000 s  tick 0       Test/ParallelAbsolute/a: started\n"
        "     0.000 s  tick 0       Test/ParallelAbsolute/b: started\n"
        "     0.100 s  tick 1       Test/ParallelAbsolute/b: waits for a at barrier 0.5\n"
        "     0.500 s  tick 5       Test/ParallelAbsolute/b: continues after 0.400 s\n"
        "     0.500 s  tick 5       Test/ParallelAbsolute/b: success\n"
        "     0.900 s  tick 9       Test/ParallelAbsolute/a: success\n"
        "     0.900 s  tick 9       run ends: success (completed) after 10 ticks\n");
}

TEST_CASE("plain lines tell that a leaf begins before they tell that it waits in the same tick") {
  const std::string text = plain("ParallelRelative[delta=0](a AsyncSequence(AlwaysSuccess b))",
                                 "a=R.9RS b=R.2R.9S", 1, btcpp::kRules);
  INFO(text);
  const auto begins = text.find("/a: started"), waits = text.find("/a: waits for ");
  CHECK(begins < waits);
  CHECK(waits != std::string::npos);
}

TEST_CASE("plain lines tell how far ahead a child is") {
  CHECK(plain("ParallelRelative[delta=.2](a b c)", "a+.1 b+.3 c+.1")
            .find("     0.200 s  tick 2       Test/ParallelRelative/b: waits for a and c, "
                  "0.40 ahead (delta 0.2)\n") != std::string::npos);
}

TEST_CASE("of waits that follow each other at once, only the first is reported, the rest counted") {
  const std::string text = plain("ParallelRelative[delta=0](a b)", "a+.1 b+.1001");
  CHECK(text.find("     0.100 s  tick 1       Test/ParallelRelative/b: waits for a, 0.00 ahead "
                  "(delta 0)\n") != std::string::npos);
  CHECK(text.find("b: waits") == text.rfind("b: waits"));
  CHECK(
      text.find("     0.200 s  tick 2       Test/ParallelRelative/b: continues after 0.100 s\n") !=
      std::string::npos);
  CHECK(text.find("... 15 short waits left out\n") != std::string::npos);
}

TEST_CASE("a wait that follows another at once is reported when it lasts, with its true time") {
  const std::string text =
      plain("ParallelRelative[delta=.1](a b)", "a=R.1R.1R.2R.2R.2R.2R.4S b=R.15R.25R.35RRS");
  CHECK(
      text.find("     0.200 s  tick 2       Test/ParallelRelative/b: waits for a, 0.15 ahead "
                "(delta 0.1)\n"
                "     0.300 s  tick 3       Test/ParallelRelative/b: continues after 0.100 s\n"
                "     0.500 s  tick 5       Test/ParallelRelative/b: waits for a, 0.15 ahead "
                "(delta 0.1), since 0.400 s\n"
                "     0.700 s  tick 7       Test/ParallelRelative/b: continues after 0.300 s\n") !=
      std::string::npos);
  CHECK(text.find("left out") == std::string::npos);
}

TEST_CASE("a wait ends with the activation of its node") {
  const std::string text = plain(
      "Retry[attempts=2](Timeout[seconds=.45](ParallelAbsolute[barriers=.5](a b)))", "a=R.1 b=R.9");
  const std::string path = "Test/Retry/Timeout/ParallelAbsolute/b: ";
  CHECK(text.find("     0.100 s  tick 1       " + path + "waits for a at barrier 0.5\n") !=
        std::string::npos);
  CHECK(text.find("     0.700 s  tick 7       " + path + "waits for a at barrier 0.5\n") !=
        std::string::npos);
  CHECK(text.find("goes on") == std::string::npos);
}

TEST_CASE("plain lines tell who is halted and what failed") {
  CHECK(
      plain("Parallel(a b)", "a=R b=RF").find("0.100 s  tick 1       Test/Parallel/a: halted\n") !=
      std::string::npos);
  const std::string fault = plain("Sequence(a)", "a=RX");
  CHECK(fault.find("Test/Sequence/a: halted\n") != std::string::npos);
  CHECK(fault.find("run ends: fault after 2 ticks\n") != std::string::npos);
}

TEST_CASE(
    "a fault that the run goes on after is reported at once, however much was reported before") {
  TextFile out;
  WatchedRun run("Repeat(a)", "a=RS...");
  run.faults[500] = {{1, "threw\x1b[2J"}};
  run.faults[501].assign(ConsolePlain::kBurstOfFaults + 9, {1, "again"});
  ConsolePlain console(shape_of(run.run.tree()), out.outlet(), frozen);
  run.watch({&console}, 1000);
  const std::string text = out.text();
  CHECK(text.find("    50.000 s  tick 500     Test/Repeat/a: failed: threw\\x1B[2J; counted as "
                  "Failure\n") != std::string::npos);
  CHECK(text.find("... 810 lines left out\n") != std::string::npos);  // 800 of them not faults
}

TEST_CASE("each completion is reported: five failed attempts are five") {
  CHECK(plain("Retry[attempts=5](a)", "a=F") ==
        "     0.000 s  tick 0       run of Test starts, 10 Hz, virtual clock\n"
        "     0.000 s  tick 0       Test/Retry/a: failure\n"
        "     0.400 s  tick 4       Test/Retry/a: failure 4 more times, in ticks 1 to 4\n"
        "     0.400 s  tick 4       run ends: failure (completed) after 5 ticks\n");
  CHECK(plain("Repeat[times=2](a)", "a=S")
            .find("     0.100 s  tick 1       Test/Repeat/a: success again in tick 1\n") !=
        std::string::npos);
  const std::string slow = plain("Retry[attempts=5](a)", "a=RF...");
  std::size_t failures = 0;
  for (std::size_t at = slow.find("a: failure\n"); at != std::string::npos; ++failures) {
    at = slow.find("a: failure\n", at + 1);
  }
  CHECK(failures == 5);
}

TEST_CASE("a leaf that completes in each tick does not flood the log, and is counted") {
  const std::string text = plain("Sequence(a? b)", "a=S b=R", 50);
  CHECK(text.find("a: success\n") == text.rfind("a: success\n"));
  CHECK(
      text.find("     4.900 s  tick 49      Test/Sequence/a: success 49 more times, in ticks 1 to "
                "49\n") != std::string::npos);
}

TEST_CASE("repeated completions are reported when the leaf does something else, or nothing") {
  CHECK(
      plain("Retry[attempts=9](Sequence(a? b))", "a=SSSF b=RRRS", 4)
          .find(
              "     0.300 s  tick 3       Test/Retry/Sequence/a: success 2 more times, in ticks 1 "
              "to 2\n"
              "     0.300 s  tick 3       Test/Retry/Sequence/a: failure\n") != std::string::npos);
  CHECK(plain("Sequence[memory=true](ForceSuccess(Retry[attempts=3](a)) b)", "a=F b=R", 8)
            .find("     0.200 s  tick 2       Test/Sequence/b: started\n"
                  "     0.300 s  tick 3       Test/Sequence/ForceSuccess/Retry/a: failure 2 more "
                  "times, in ticks 1 to 2\n") != std::string::npos);
}

TEST_CASE("plain lines of a long run are bounded") {
  const std::string text = plain("Repeat(a)", "a=RS...", 100'000);
  CHECK(std::count(text.begin(), text.end(), '\n') == ConsolePlain::kBurst + 3);
  CHECK(text.find("... 99800 lines left out\n") != std::string::npos);
}

TEST_CASE("after the burst there is a line for each second") {
  const auto at = [](int milliseconds) {
    return Nanoseconds(std::chrono::hours(1) + std::chrono::milliseconds(milliseconds));
  };
  LineBudget budget(2);
  CHECK(budget.take(at(0)));
  CHECK(budget.take(at(0)));
  CHECK_FALSE(budget.take(at(1)));
  CHECK_FALSE(budget.take(at(999)));
  CHECK(budget.take(at(1000)));
  CHECK(budget.take_left_out() == 2);
  CHECK_FALSE(budget.take(at(1001)));
  CHECK(budget.take(at(60'000)));
  CHECK(budget.take(at(60'000)));
  CHECK_FALSE(budget.take(at(60'000)));
}

TEST_CASE("the live view leaves the last state and the cursor on the screen") {
  TextFile out;
  WatchedRun run("ParallelAbsolute[barriers=.5;1](a b)", "a+.25 b+.5");
  ConsoleLive live(shape_of(run.run.tree()), {.color = false, .unicode = false}, out.outlet());
  live.print("a line of a leaf");
  run.watch({&live});
  const std::string text = out.text();
  CHECK(text.starts_with("\x1b[?25l"));
  CHECK(text.find("a line of a leaf\x1b[K\n") != std::string::npos);
  const std::string last =
      "Test  10 Hz (virtual)  tick 3  0.300 s  success\x1b[K\n"
      "+ ParallelAbsolute\x1b[K\n"
      "  + a [##########|#########] 1.00\x1b[K\n"
      "  + b [##########|#########] 1.00\x1b[K\n"
      "\x1b[J\x1b[?25h";
  CHECK(text.substr(text.size() - std::min(text.size(), last.size())) == last);
}

TEST_CASE("the live view shows which round of Retry and Repeat it is") {
  TextFile out;
  WatchedRun run("Parallel(Retry[attempts=8](a) Repeat[times=4](b) Repeat(c) d)",
                 "a=RF b=RS c=RS d=R");
  ConsoleLive live(shape_of(run.run.tree()), {.color = false, .unicode = false}, out.outlet());
  run.watch({&live}, 3);
  const std::string text = out.text();
  const std::string last = text.substr(text.rfind("Test  10 Hz"));
  CHECK(last.find("> Retry  3/8\x1b[K\n") != std::string::npos);
  CHECK(last.find("  3/4\x1b[K\n") != std::string::npos);
  CHECK(last.find("  3\x1b[K\n") != std::string::npos);
  CHECK(last.find("> d (Scripted)\x1b[K\n") != std::string::npos);
}

TEST_CASE("no line is lost after the last frame, and too many are counted") {
  TextFile out;
  WatchedRun run("Sequence(a)", "a=S");
  ConsoleLive live(shape_of(run.run.tree()), {}, out.outlet());
  for (std::size_t i = 0; i < ConsoleLive::kMostLines + 7; ++i) live.print("early");
  run.watch({&live});
  live.print("late");
  const std::string text = out.text();
  CHECK(text.find("... 7 lines left out") != std::string::npos);
  CHECK(text.ends_with("\x1b[?25hlate\n"));
}

TEST_CASE("a live view that is given up restores the cursor") {
  TextFile out;
  WatchedRun run("Sequence(a)", "a=R");
  {
    ConsoleLive live(shape_of(run.run.tree()), {}, out.outlet());
    LiveMoments moments(run.run.tree());
    live.run_started(moments.now(run.run.ticker()), run.start);
  }
  CHECK(out.text().ends_with("\x1b[?25h"));
}

}  // namespace
}  // namespace lockstep::host

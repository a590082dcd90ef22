// What is wrong with a study is told before its first run, and nothing is written.
#include <catch2/catch.hpp>
#include <filesystem>

#include "study/study_case.h"

namespace lockstep::host::test {
namespace {

struct Refusal {
  int code;
  std::vector<std::string> arguments;
  std::string message;
};

const std::vector<Refusal> kRefusals{
    {2, {}, "--runs is required"},
    {2, {"--runs", "0"}, "'0' is not a whole number from 1"},
    {2, {"--runs", "-3"}, "not a whole number"},
    {2, {"--runs", "1", "--grid", "barier_count=1"}, "unknown name 'barier_count' in --grid"},
    {2, {"--runs", "1", "--grid", "barier_count=1"}, "did you mean 'barrier_count'?"},
    {2, {"--runs", "1", "--grid", "noise"}, "expected name=value"},
    {2, {"--runs", "1", "--grid", "noise=1,1"}, "the value '1' is given twice"},
    {2, {"--runs", "1", "--grid", "noise=0:1:0"}, "--grid noise: the step of the range is 0"},
    {2, {"--runs", "1", "--grid", "noise=0:1:-0.1"}, "a step of -0.1 does not lead from 0 to 1"},
    {2, {"--runs", "1", "--grid", "noise=0:1:0.000001"}, "has 1000001 values, at most 100000"},
    {3, {"--runs", "1", "--grid", "noise=0:0.1:0.05,0.2"}, "0:0.1:0.05"},  // a list of two texts
    {2, {"--runs", "1", "--grid", "noise,barrier_count=0:1,1"}, "'1' has 1 of 2 values"},
    {2, {"--runs", "1", "--grid", "noise,barrier_count=0:1:2"}, "'0:1:2' has 3 of 2 values"},
    {2, {"--runs", "1", "--grid", "noise=0,0.5,.50"}, "the value '.50' is given twice"},
    {2, {"--runs", "1", "--grid", "noise=0,-0.0"}, "the value '-0.0' is given twice"},
    {2, {"--runs", "1", "--grid", "noise,barrier_count=0:1,0:1"}, "'0:1' is given twice"},
    {2, {"--runs", "1", "--grid", "noise,noise=0:1"}, "--grid noise,noise: a name is given twice"},
    {2, {"--runs", "1", "--grid", "noise,=0:1"}, "expected name=value"},
    {2, {"--runs", "1", "--grid", "noise,spread=0:1"}, "unknown name 'spread' in --grid"},
    {2, {"--runs", "1", "--grid", "noise,rate=0:1,0.1:0"}, "'0' is not a number from 0.001"},
    {2, {"--runs", "1", "--grid", "noise,seed=0:1", "--grid", "noise=0"}, "noise: given twice"},
    {2, {"--runs", "1", "--grid", "noise,seed=0:1", "--arg", "noise=0"}, "by --grid and by --arg"},
    {2,
     {"--runs", "1", "--grid", "seed=1:400:1", "--grid", "noise=0:1:0.001"},
     "the grid has 400400 cells, at most 100000"},
    {2, {"--runs", "1", "--grid", "noise=0", "--grid", "noise=1"}, "given twice"},
    {2, {"--runs", "1", "--grid", "noise=0", "--arg", "noise=1"}, "both by --grid and by --arg"},
    {2, {"--runs", "1", "--grid", "seed=1,x"}, "'x' is not a whole number"},
    {2, {"--runs", "18446744073709551616"}, "is more than 18446744073709551615"},
    {2, {"--runs", "1", "--seed", "18446744073709551616"}, "is more than 18446744073709551615"},
    {2, {"--runs", "1", "--max-ticks", "99999999999999999999"}, "is more than 1844674407370955"},
    {2, {"--runs", "1", "--grid", "seed=18446744073709551616"}, "is more than 18446744073709551"},
    {2, {"--runs", "18446744073709551615"}, "more than 281474976710656 runs"},
    {2, {"--runs", "281474976710656", "--grid", "noise=0,1"}, "more than 281474976710656 runs"},
    {2, {"--runs", "00"}, "'00' is not a whole number from 1"},
    {2, {"--runs", "1", "--grid", "rate=0"}, "'0' is not a number from 0.001"},
    {2, {"--runs", "1", "--measure", "speed"}, "unknown measure 'speed'"},
    {2, {"--runs", "1", "--measure", "predictability:a1@2"}, "expected a number from 0 to 1"},
    {2,
     {"--runs", "1", "--measure", "predictability:a9@0.5"},
     "did you mean 'a1' or 'a2' or 'a3'?"},
    {2, {"--until-ci", "5%"}, "--runs is required"},
    {2, {"--runs", "9", "--until-ci", "0"}, "--until-ci 0: expected a width above 0"},
    {2, {"--runs", "9", "--until-ci", "narrow"}, "such as 5%, of the median"},
    {2, {"--runs", "9", "--until-ci", "-1%"}, "--until-ci"},
    {2, {"--runs", "9", "--until-ci", ""}, "'--until-ci' needs a value"},
    {2, {"--runs", "1", "--shard", "3/2"}, "expected I/N"},
    {2, {"--runs", "1", "--shard", "1"}, "expected I/N"},
    {2, {"--runs", "1", "--shard", "1/18446744073709551617"}, "expected I/N"},
    {2, {"--runs", "1", "--shard", "1/2"}, "cannot be made in 2 parts"},
    {3, {"--runs", "1", "--grid", "noise=0,much"}, "much"},
};

}  // namespace

TEST_CASE("a study that cannot be made is refused before it is begun") {
  const StudyCase it;
  for (const Refusal& refusal : kRefusals) {
    auto arguments = refusal.arguments;
    arguments.insert(arguments.begin(), kPaper + "example5.xml");
    const Outcome outcome = it.study(arguments, "out");
    INFO(refusal.message << '\n' << outcome.err);
    CHECK(outcome.code == refusal.code);
    CHECK(contains(outcome.err, refusal.message));
    CHECK_FALSE(std::filesystem::exists(it.path("out")));
  }
}

TEST_CASE("what is wrong in several cells is reported for all of them") {
  const StudyCase it;
  const Outcome outcome = it.study({kPaper + "example5.xml", "--runs", "1", "--grid",
                                    "noise=0,much,0.1,more", "--grid", "barrier_count=1,few"},
                                   "out");
  CHECK(outcome.code == 3);
  for (const char* value : {"much", "more", "few"}) CHECK(contains(outcome.err, value));
}

TEST_CASE("a tree without a parallel has no progress distance") {
  const StudyCase it;
  const auto tree = it.file("tree.xml", tree_text("<Advance/>"));
  const Outcome outcome = it.study({tree, "--runs", "1"}, "out");
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "the tree has no parallel"));
}

}  // namespace lockstep::host::test

// Leaves that fail in the halt at the end of a run: what they move may not have stopped, so the run
// does not end as if it had.
#include <signal.h>

#include <catch2/catch.hpp>

#include "reliability/hostile_tree.h"
#include "support/json.h"

namespace lockstep::host::test {
namespace {

using nlohmann::json;
using Strings = std::vector<std::string>;

constexpr int kFault = 5;
const std::string kTold = "could not be halted";

std::string leaf(const std::string& name, const std::string& how) {
  return "<Misbehave name=\"" + name + "\" how=\"" + how +
         "\" where=\"halt\" ticks=\"1000000000\"/>";
}

// Runs until it is stopped, with two leaves that cannot be halted beside one that can.
std::string endless_tree() {
  return "<root lockstep=\"1\"><plugin name=\"hostile\"/><BehaviorTree ID=\"Main\"><Parallel>" +
         leaf("arm", "throw exception") + leaf("base", "") + leaf("lift", "set error") +
         "</Parallel></BehaviorTree></root>";
}

struct Endless {
  Strings arguments(const Strings& options) const {
    Strings all{"run", tree, "--plugin-path", LOCKSTEP_HOSTILE_DIRECTORY};
    all.insert(all.end(), options.begin(), options.end());
    return all;
  }

  TemporaryDirectory directory;
  std::string tree = directory.file("tree.xml", endless_tree());
};

void check(const Outcome& outcome) {
  INFO(outcome.err << outcome.out);
  CHECK(outcome.code == kFault);
  const std::string of_plugin = " (Misbehave of plugin 'hostile') " + kTold + " at the end of the ";
  CHECK(contains(outcome.err, "the leaf 'Main/Parallel/arm'" + of_plugin +
                                  "run: threw an exception: out of reach"));
  CHECK(contains(outcome.err, "the leaf 'Main/Parallel/lift'" + of_plugin + "run: lost the arm"));
  CHECK(contains(outcome.err, "Main/Parallel/base: halted"));
}

}  // namespace

TEST_CASE(
    "a leaf that cannot be halted at a limit is a fault, with any policy, and all are reported") {
  const Endless it;
  const std::string file = it.directory.path("run.jsonl");
  for (const Strings& limit : {Strings{"--max-ticks", "3"}, Strings{"--timeout", "0.025"}}) {
    for (const std::string policy : {"stop", "fail"}) {
      for (const std::string where : {"", "--isolate"}) {
        INFO(limit[0] << ' ' << policy << ' ' << where);
        Strings options{"--clock", "virtual", "--json", "--record", file, "--on-fault", policy};
        options.insert(options.end(), limit.begin(), limit.end());
        if (!where.empty()) options.push_back(where);
        const Outcome outcome = run_lockstep(it.arguments(options));
        check(outcome);
        const json summary = parse_json(outcome.out);
        CHECK(summary["result"] == "fault");
        CHECK(summary["fault"] ==
              "Main/Parallel/arm: " + kTold + ": threw an exception: out of reach");
        CHECK(summary["ticks"] == 3);
        CHECK(summary["notes"][0] == "the leaf 'Main/Parallel/lift' " + kTold + ": lost the arm");
        const json end = parse_json(lines(read_file(file)).back())["end"];
        CHECK(end["result"] == "fault");
        CHECK(end["fault"] == summary["fault"]);
      }
    }
  }
}

TEST_CASE("a leaf that cannot be halted at a signal is a fault, no matter which signal") {
  const Endless it;
  for (const int number : {SIGINT, SIGTERM}) {
    Process process({.arguments = it.arguments({})});
    REQUIRE(process.wait_for("Main/Parallel/lift: started"));
    process.signal(number);
    check(process.finish());
  }
}

TEST_CASE("a leaf that cannot be halted after a fault is reported beside the leaf at fault") {
  const TemporaryDirectory directory;
  std::string text = endless_tree();
  const std::string base = leaf("base", "");
  text.replace(text.find(base), base.size(),
               "<Misbehave name=\"culprit\" how=\"nonsense\" at=\"2\"/>");
  const Outcome outcome =
      run_lockstep({"run", directory.file("tree.xml", text), "--plugin-path",
                    LOCKSTEP_HOSTILE_DIRECTORY, "--clock", "virtual", "--view", "none", "--json"});
  INFO(outcome.err);
  CHECK(outcome.code == kFault);
  CHECK(contains(parse_json(outcome.out)["fault"], "culprit: returned status 7"));
  CHECK(lines(outcome.err).size() == 3);
  CHECK(contains(outcome.err, "'Main/Parallel/arm' (Misbehave of plugin 'hostile') " + kTold));
  CHECK(contains(outcome.err, "'Main/Parallel/lift' (Misbehave of plugin 'hostile') " + kTold));
}

TEST_CASE("a study ends at a leaf that cannot be halted") {
  const Endless it;
  const Outcome outcome = run_lockstep(
      {"study", it.tree, "--runs", "3", "--measure", "duration", "--max-ticks", "4",
       "--plugin-path", LOCKSTEP_HOSTILE_DIRECTORY, "--out", it.directory.path("out")});
  INFO(outcome.err);
  CHECK(outcome.code == kFault);
  CHECK(contains(outcome.err, "the leaf 'Main/Parallel/arm' (Misbehave of plugin 'hostile') " +
                                  kTold + " at the end of the run, in run 0 of cell 0"));
}

}  // namespace lockstep::host::test

// The plugin exec: commands as leaves.
#include <catch2/catch.hpp>
#include <filesystem>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

Outcome run_command(const std::string& attributes) {
  const TemporaryDirectory directory;
  return run_lockstep(
      {"run",
       directory.file("tree.xml",
                      "<root lockstep=\"1\"><plugin name=\"exec\" program=\"exec.py\" "
                      "hold=\"signal\"/><BehaviorTree ID=\"Main\"><Exec " +
                          attributes + "/></BehaviorTree></root>"),
       "--timeout", "5"});
}

}  // namespace

TEST_CASE("a command succeeds with exit code 0, and its last lines say why it fails") {
  CHECK(run_command("command=\"true\"").code == 0);
  const Outcome bad = run_command("command=\"ls '/no such' {a}\" a=\"/neither this\"");
  INFO(bad.err);
  CHECK(bad.code == 1);
  CHECK(contains(bad.err, "warning: exit code 2: ls '/no such' {a}"));
  CHECK(contains(bad.err, "'/neither this'"));
  const Outcome missing = run_command("command=\"no_such_command\"");
  CHECK(missing.code == 5);
  CHECK(contains(missing.err, "No such file or directory: 'no_such_command'"));
}

TEST_CASE("no shell reads a command, unless it is asked for") {
  const TemporaryDirectory directory;
  const std::string victim = directory.path("victim");
  CHECK(run_command("command=\"echo {a}\" a=\"; touch '" + victim + "'\"").code == 0);
  CHECK(run_command("command=\"echo $(touch '" + victim + "')\"").code == 0);
  CHECK(!std::filesystem::exists(victim));
  CHECK(run_command("shell=\"true\" command=\"touch &quot;$a&quot;\" a=\"" + victim + "\"").code ==
        0);
  CHECK(std::filesystem::exists(victim));
}

TEST_CASE("a command that is halted ends with all that it has started, and no other command does") {
  const TemporaryDirectory directory;
  const std::string other = directory.path("other"), survivor = directory.path("survivor");
  const Outcome outcome = run_lockstep(
      {"run",
       directory.file(
           "tree.xml",
           R"(<root lockstep="1"><plugin name="exec" program="exec.py"/><BehaviorTree ID="Main">
<Parallel><Fallback><Timeout seconds="0.3"><Exec name="long" shell="true"
command="(trap '' TERM; sleep 2.5; touch ')" +
               survivor +
               R"(') &amp; env -i sleep 98 &amp; wait"/></Timeout><AlwaysSuccess/></Fallback>
<Exec name="other" shell="true" command="sleep 3.2; touch ')" +
               other + R"('"/>
<Wait seconds="1"/></Parallel></BehaviorTree></root>)"),
       "--timeout", "8"});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err, "long: halted"));
  CHECK(std::filesystem::exists(other));
  CHECK(!std::filesystem::exists(survivor));
}

TEST_CASE("a shell that is halted does not go on with its next command") {
  const TemporaryDirectory directory;
  const std::string survivor = directory.path("survivor");
  const Outcome outcome = run_lockstep(
      {"run",
       directory.file(
           "tree.xml",
           R"(<root lockstep="1"><plugin name="exec" program="exec.py"/><BehaviorTree ID="Main">
<Fallback><Timeout seconds="0.5"><Exec shell="true" command="for i in $(seq 80); do (trap '' TERM;
sleep 96; : >')" +
               survivor + R"(') &amp; done; wait"/></Timeout><AlwaysSuccess/></Fallback>
</BehaviorTree></root>)"),
       "--timeout", "8"});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(!std::filesystem::exists(survivor));
}

TEST_CASE("the output of a command is its progress, and a command that is halted ends") {
  const TemporaryDirectory directory;
  const Outcome outcome = run_lockstep(
      {"run",
       directory.file("tree.xml", R"(<root lockstep="1"><plugin name="exec" program="exec.py"/>
<plugin name="motion"/><BehaviorTree ID="Main"><Parallel success_count="1"><ParallelAbsolute barriers="0.3;0.5">
<Exec name="load" shell="true" progress_from="percent" command="for i in 10 20 30 40; do echo $i%; done; sleep 97"/>
<Advance name="arm" step="0.1"/></ParallelAbsolute><Wait seconds="0.7"/></Parallel></BehaviorTree></root>)"),
       "--timeout", "5"});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err, "arm: waits for load at barrier 0.5"));
  CHECK(contains(outcome.err, "load: halted"));
}

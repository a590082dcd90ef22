// Trees that ask people, in scenarios, proofs and recordings of runs.
#include <catch2/catch.hpp>

#include "support/program.h"

using namespace lockstep::host::test;

namespace {

constexpr auto kAskingTree = R"(<root lockstep="1"><BehaviorTree ID="Main"><Sequence memory="true">
<Script code="part := 'gear'"/>
<Ask name="where" text="Where shall {part} go?" options="left;right" answer="{side}" timeout="2" default="left"/>
<Switch on="side" cases="left;right"><Wait name="to_left" seconds="0.2"/>
<Sequence memory="true"><Ask name="sure" text="Sure?"/><Wait name="to_right" seconds="0.2"/></Sequence></Switch>
</Sequence></BehaviorTree></root>)";

class AskFolder {
 public:
  explicit AskFolder(const std::string& scenario) {
    directory_.file("t.xml", kAskingTree);
    directory_.file("t.test.xml",
                    "<scenarios lockstep=\"1\" tree=\"t.xml\"><scenario name=\"one\">" + scenario +
                        "</scenario></scenarios>\n");
  }
  Outcome test() const { return shell("lockstep test t.test.xml", directory_); }
  const TemporaryDirectory& directory() const { return directory_; }

 private:
  TemporaryDirectory directory_;
};

void check_asking(const std::string& scenario, const std::string& message = {}) {
  const Outcome run = AskFolder(scenario).test();
  INFO(scenario << '\n' << run.out << run.err);
  CHECK((run.code == 0) == message.empty());
  if (!message.empty()) CHECK(contains(run.out + run.err, message));
}

}  // namespace

TEST_CASE("an Ask whose timeout is no time asks nothing before its fault") {
  const TemporaryDirectory directory;
  for (const auto& [timeout, code] : {std::pair("-1.0", 5), std::pair("0.02", 1)}) {
    directory.file("t.xml", std::string(R"(<root lockstep="1"><BehaviorTree ID="M">
      <Sequence memory="true"><Script code="t := )") +
                                timeout + R"("/>
      <Ask name="q" text="Go?" options="yes;no" timeout="{t}"/></Sequence></BehaviorTree></root>)");
    const Outcome it = shell("lockstep run t.xml --clock virtual --view plain", directory);
    INFO(it.out << it.err);
    CHECK(it.code == code);
    CHECK(contains(it.out + it.err, "asks: Go? (yes, no)") == (code == 1));
    CHECK(contains(it.out + it.err, "asks:") == (code == 1));
  }
}

TEST_CASE("scenario: without an answer the time of an Ask passes") {
  check_asking(R"(<expect order="to_left.success"/><expect result="success" time="2.2..2.4"/>)");
}

TEST_CASE("scenario: what a person answers, whenever it is asked, at a tick, at a time") {
  check_asking(R"(<answer path="where" value="right"/><answer path="sure" value="yes"/>
    <expect order="where.success; sure.success; to_right.success"/><expect result="success"/>)");
  check_asking(
      R"(<answer path="where" value="right" tick="5"/><answer path="sure" value="no" time="1.5"/>
    <expect result="failure" time="1.5..1.7"/><expect>never to_left.running</expect>)");
}

TEST_CASE("scenario: an answer that nobody asks for is a failure, and mistakes are found") {
  check_asking(
      R"(<answer path="sure" value="yes" tick="3"/><expect result="success"/>)",
      "'Main/Sequence/Switch/Sequence/sure' does not ask before tick 3, so 'yes' answers nothing");
  check_asking(R"(<answer path="where" value="left" tick="140"/><expect result="success"/>)",
               "tick 140 does not come: the run ends after ");
  check_asking(R"(<answer path="where" value="left" time="3.5"/><expect result="success"/>)",
               "the time 3.5 s does not come: the run ends after ");
  check_asking(R"(<answer path="where" value="rihgt"/><expect result="success"/>)",
               "did you mean 'right'?");
  check_asking(R"(<answer path="nobody" value="yes"/><expect result="success"/>)",
               "no node with the path 'nobody' asks anything");
  check_asking(
      R"(<answer path="where" value="left"/><leaf path="where" result="success" out.answer="left"/>
    <expect result="success"/>)",
      "has a <leaf> that declares what it does");
}

TEST_CASE("verify: a person may give each answer, or none in time") {
  const AskFolder folder("<expect result=\"success\"/>");
  const auto verify = [&](const std::string& property) {
    return shell("lockstep verify t.xml --property '" + property + "'", folder.directory());
  };
  const Outcome both = verify("never to_right.running");
  INFO(both.out << both.err);
  CHECK(both.code == 1);
  CHECK(verify("never to_left.running").code == 1);
  CHECK(verify("never to_left.running and to_right.running").code == 0);
  CHECK(verify("to_right.running only after sure.success").code == 0);
  CHECK(verify("never sure.failure").code == 1);
  CHECK(verify("never where.failure").code == 0);
}

TEST_CASE("a run with an answer becomes a scenario that gives it again") {
  const AskFolder folder(
      R"(<answer path="where" value="right" tick="3"/><answer path="sure" value="yes"/>
    <expect result="success"/><expect same-as="run.jsonl"/>)");
  REQUIRE(shell("lockstep test t.test.xml --update", folder.directory()).code == 0);
  const Outcome made = shell(
      "lockstep log scenario run.jsonl > again.test.xml && "
      "lockstep test again.test.xml",
      folder.directory());
  INFO(made.out << made.err);
  CHECK(made.code == 0);
}

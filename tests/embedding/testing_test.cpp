// Tests of trees by lockstep/testing.hpp: its laws, on trees whose plugins are not there.
#include <catch2/catch.hpp>
#include <filesystem>
#include <lockstep/testing.hpp>

namespace {

using lockstep::Status;
using lockstep::testing::TreeTest;
using Strings = std::vector<std::string>;

// No plugin has these leaves.
const char* const kDoor = R"(
<root lockstep="1">
  <property name="order">never base.success and arm.running</property>
  <BehaviorTree ID="Main">
    <Sequence>
      <IsOpen name="open"/>
      <ParallelAbsolute name="pull" barriers="0.5"><Reach name="arm"/><Drive name="base"/></ParallelAbsolute>
    </Sequence>
  </BehaviorTree>
</root>)";

std::string wrong(const std::function<void()>& call) {
  try {
    call();
  } catch (const lockstep::runtime::Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("TreeTest: leaves succeed at once when nothing is said") {
  TreeTest tree = TreeTest::from_text(kDoor);
  CHECK(tree.run() == Status::Success);
  CHECK(tree.ticks() == 1);
  CHECK(tree.violations().empty());
}

TEST_CASE(
    "TreeTest: leaves do what the test says, tick by tick, and synchronized nodes hold them") {
  TreeTest tree = TreeTest::from_text(kDoor);
  tree.leaf("arm", "R.2 R.4 R.6 R.8 S").leaf("Main/Sequence/pull/base", "R.5 S");
  CHECK(tree.tick() == Status::Running);
  CHECK(tree.node("base").progress == 0.5);
  tree.tick();
  CHECK(tree.node("pull/base").held);
  CHECK(tree.run() == Status::Success);
  CHECK(tree.ticks() == 5);
  CHECK(tree.seconds() == Approx(0.5));
  CHECK(tree.tick() == Status::Success);  // nothing is ticked any more
  CHECK(tree.ticks() == 5);
}

TEST_CASE("TreeTest: a violated property says when, those of the file too") {
  TreeTest tree = TreeTest::from_text(kDoor);
  tree.leaf("arm", "R.1 R.2 R.9 S").leaf("base", "S").check("sometimes open.failure");
  CHECK(tree.run() == Status::Success);
  CHECK(tree.violations() == Strings{"order: violated in tick 0, at 0.000 s",
                                     "sometimes open.failure: violated at the end, after 4 ticks"});
}

TEST_CASE("TreeTest: a leaf may begin with its first word in each activation") {
  const char* const retry = R"(<root lockstep="1"><BehaviorTree ID="Main">
    <Retry attempts="2"><Grip name="grip"/></Retry></BehaviorTree></root>)";
  TreeTest once = TreeTest::from_text(retry), each = TreeTest::from_text(retry);
  once.leaf("grip", "F S");
  CHECK(once.run() == Status::Success);
  each.leaf_each("grip", "F S");
  CHECK(each.run() == Status::Failure);
}

TEST_CASE("TreeTest: a fault ends the run, and says of whom") {
  TreeTest tree = TreeTest::from_text(kDoor);
  tree.leaf("arm", "R.2 X");
  CHECK(tree.run() == Status::Running);
  CHECK(tree.is_over());
  CHECK(tree.ticks() == 2);
  CHECK(tree.fault().find("Main/Sequence/pull/arm") != std::string::npos);
}

TEST_CASE("TreeTest: entries are set before the first tick and between ticks") {
  TreeTest tree = TreeTest::from_text(R"(<root lockstep="1"><BehaviorTree ID="Main">
    <Sequence><Script code="n := n + 1"/><Check code="n == 11"/></Sequence></BehaviorTree></root>)");
  tree.set("n", 10.0);
  tree.check("never {n} > 11");
  CHECK(tree.run() == Status::Success);
  CHECK(tree.get<double>("n") == 11);
  CHECK(tree.violations().empty());
}

TEST_CASE("TreeTest: what is wrong is said where it is said") {
  TreeTest tree = TreeTest::from_text(kDoor);
  CHECK(wrong([&] { tree.leaf("arn", "S"); }).find("'Main/Sequence/pull/arm'") !=
        std::string::npos);
  CHECK(wrong([&] { tree.leaf("arm", "R.5 Q"); }).find("'Q' is not a word") != std::string::npos);
  CHECK(wrong([&] { tree.leaf("arm", ""); }).find("at least one word") != std::string::npos);
  CHECK(wrong([&] { tree.leaf("arm", "S[place=x]"); }).find("no output 'place'") !=
        std::string::npos);
  CHECK(wrong([&] { tree.node("elsewhere"); }).find("no node 'elsewhere'") != std::string::npos);
  tree.check("never arm.runing");
  CHECK(wrong([&] { tree.tick(); }).find("column 11") != std::string::npos);
  CHECK(wrong([] { TreeTest("/nowhere.xml"); }).find("/nowhere.xml") != std::string::npos);
}

// The door scene of plugins/r1sim: the door opens if arm and base stay together, and jams if not.
#include <catch2/catch.hpp>

#include "unit/plugins/tree_run.h"

namespace lockstep::host::test {
namespace {

const std::string kDoorLeaves = "<PullDoor name=\"arm\"/><BackAway name=\"base\"/>";

std::string open_door(const std::string& barriers, const std::string& leaves = kDoorLeaves) {
  return "<ParallelAbsolute barriers=\"" + barriers + "\">" + leaves + "</ParallelAbsolute>";
}

int opened_doors(const std::string& tree, double rate) {
  const TreeRunner runner("r1sim", tree);
  int count = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const TreeRunEnd end = runner.run({.seed = seed, .rate = rate});
    CHECK(end.fault.empty());
    CHECK(end.status != Status::Running);
    CHECK((end.status == Status::Success) == end.log.empty());
    count += end.status == Status::Success;
  }
  return count;
}

}  // namespace

TEST_CASE("a door jams unless arm and base are in step, at any rate", "[plugins][r1sim]") {
  for (const double rate : {20.0, 100.0, 500.0}) {
    INFO("at " << rate << " Hz");
    CHECK(opened_doors(open_door("0.25;0.5;0.75"), rate) == 40);
    CHECK(opened_doors(open_door("0.5"), rate) == 40);
    CHECK(opened_doors("<ParallelRelative delta=\"0.3\">" + kDoorLeaves + "</ParallelRelative>",
                       rate) == 40);
    CHECK(opened_doors(open_door(""), rate) == 0);
    CHECK(opened_doors(open_door("0.9"), rate) == 0);
    CHECK(opened_doors("<Parallel>" + kDoorLeaves + "</Parallel>", rate) == 0);
  }
}

TEST_CASE("a door jams in both directions, and whoever comes first", "[plugins][r1sim]") {
  const auto jam = [](const std::string& leaves) {
    const TreeRunEnd end = TreeRunner("r1sim", open_door("", leaves)).run();
    CHECK(end.status == Status::Failure);
    return end.log;
  };
  CHECK(jam("<PullDoor spread=\"0\"/><BackAway spread=\"0\"/>") ==
        std::vector<std::string>{
            "the door jams: the hand has moved 0.268000 m, the base 0.670000 m"});
  CHECK(jam("<BackAway spread=\"0\"/><PullDoor spread=\"0\"/>").size() == 1);
  CHECK(jam("<PullDoor speed=\"0.9\"/><BackAway speed=\"0.1\"/>").size() == 1);
  CHECK(jam("<PullDoor way=\"0.3\"/><BackAway way=\"0.8\"/>").size() == 1);
}

TEST_CASE("an arm without a base that makes room does not open a door", "[plugins][r1sim]") {
  CHECK(opened_doors("<PullDoor/>", 100) == 0);
  CHECK(opened_doors("<Sequence memory=\"true\"><PullDoor/><BackAway/></Sequence>", 100) == 0);
  CHECK(opened_doors("<BackAway/>", 100) == 40);  // there is no door
}

TEST_CASE("hand and base take their ways over their speeds, at any rate", "[plugins][r1sim]") {
  const TreeRunner runner("r1sim", open_door("0.5",
                                             "<PullDoor way=\"2\" slack=\"9\" spread=\"0\"/>"
                                             "<BackAway spread=\"0\"/>"));
  for (const double rate : {20.0, 100.0, 1000.0}) {
    const TreeRunEnd end = runner.run({.rate = rate});
    CHECK(end.status == Status::Success);
    CHECK(end.seconds == Approx(10).margin(3 / rate));
  }
}

TEST_CASE("a base that is held stands still", "[plugins][r1sim]") {
  const TreeRunner runner("r1sim", open_door("0.5"));
  const NodeIndex base = runner.node("base");
  double held = 0;
  const auto check = [&](Ticker& ticker) {
    if (!ticker.held(base)) return;
    held += 0.01;
    CHECK(ticker.progress(base) == Approx(0.5).margin(0.01));
  };
  CHECK(runner.run({.after_tick = check}).status == Status::Success);
  CHECK(held > 1);
}

TEST_CASE("a door that jammed can be tried again", "[plugins][r1sim]") {
  const std::string jams = "<Inverter>" + open_door("") + "</Inverter>";
  const TreeRunEnd end = TreeRunner("r1sim", "<Sequence memory=\"true\">" + jams +
                                                 open_door("0.5") + jams + "</Sequence>")
                             .run();
  CHECK(end.status == Status::Success);
  CHECK(end.log.size() == 2);
}

TEST_CASE("a way must be one", "[plugins][r1sim]") {
  CHECK(TreeRunner("r1sim", "<BackAway way=\"0\"/>").run().fault ==
        "port 'way' must be greater than 0");
  CHECK(TreeRunner("r1sim", "<PullDoor way=\"-1\"/>").run().fault ==
        "port 'way' must be greater than 0");
}

}  // namespace lockstep::host::test

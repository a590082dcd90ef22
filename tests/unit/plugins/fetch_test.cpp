// The leaves of plugins/fetch, one law a row: a tree that succeeds if the law holds, whatever the
// doors, the battery and the objects' places are in that run.
#include <catch2/catch.hpp>

#include <algorithm>

#include "unit/plugins/tree_run.h"

namespace lockstep::host::test {
namespace {

struct Law {
  std::string law;
  std::string nodes;
};

std::string steps(const std::string& nodes) {
  return "<Sequence memory=\"true\">" + nodes + "</Sequence>";
}
std::string fails(const std::string& node) {
  return "<Inverter>" + node + "</Inverter>";
}
std::string either(const std::string& nodes) {
  return "<Fallback memory=\"true\">" + nodes + "</Fallback>";
}
std::string enter(const std::string& room) {
  return "<DriveTo place=\"" + room + "_door\"/><OpenDoor door=\"" + room +
         "\" failure=\"0\"/><DriveTo place=\"" + room + "\"/>";
}
// Finds the mug and drives to it.
std::string go_to_mug() {
  const std::string look = "<LookFor object=\"mug\" place=\"{spot}\"/>";
  return either(steps(enter("kitchen") + look) + steps(enter("office") + look)) +
         "<DriveTo place=\"{spot}\"/>";
}
std::string grasp(const std::string& object, const std::string& failure = "0") {
  return "<Grasp object=\"" + object + "\" failure=\"" + failure + "\"/>";
}

const std::string kHolding = "<Holding object=\"mug\"/>";

const Law kLaws[] = {
    {"the robot starts at the dock", "<At place=\"dock\"/>"},
    {"DriveTo ends at the place, and nowhere else",
     steps("<DriveTo place=\"sofa\"/><At place=\"sofa\"/>" + fails("<At place=\"dock\"/>"))},
    {"a robot that was stopped on its way is at no place",
     steps(fails("<Timeout seconds=\"1\"><DriveTo place=\"sofa\"/></Timeout>") +
           fails("<At place=\"dock\"/>") + fails("<At place=\"sofa\"/>"))},
    {"a closed door is no way",
     either("<DoorOpen door=\"kitchen\"/>" + fails("<DriveTo place=\"kitchen\"/>"))},
    {"an opened door is one", steps(enter("kitchen") + "<At place=\"kitchen\"/>"
                                                       "<DoorOpen door=\"kitchen\"/>")},
    {"a door is opened from where it is",
     either("<DoorOpen door=\"office\"/>" + fails("<OpenDoor door=\"office\" failure=\"0\"/>"))},
    {"a handle may slip", either("<DoorOpen door=\"office\"/>" +
                                 steps("<DriveTo place=\"office_door\"/>" +
                                       fails("<OpenDoor door=\"office\" failure=\"1\"/>") +
                                       fails("<DoorOpen door=\"office\"/>")))},
    {"LookFor sees nothing in other rooms", fails("<LookFor object=\"mug\" place=\"{spot}\"/>")},
    {"LookFor tells the place, and ObjectSeen keeps it",
     steps(go_to_mug() + "<ObjectSeen object=\"mug\" place=\"{seen}\"/><At place=\"{seen}\"/>")},
    {"nothing is seen at first", fails("<ObjectSeen object=\"mug\"/>")},
    {"an object is grasped where it lies", steps(go_to_mug() + grasp("mug") + kHolding)},
    {"and nowhere else", fails(grasp("mug"))},
    {"a gripper may miss", steps(go_to_mug() + fails(grasp("mug", "1")) + fails(kHolding))},
    {"a gripper holds one object", steps(go_to_mug() + grasp("mug") + fails(grasp("book")))},
    {"Place puts it where the robot is",
     steps(go_to_mug() + grasp("mug") + "<DriveTo place=\"sofa\"/><Place/>" + fails(kHolding) +
           "<ObjectSeen object=\"mug\" place=\"{now}\"/>" + fails("<Place/>") + grasp("mug"))},
    {"a battery is charged at the dock", steps("<Charge level=\"0.95\"/>"
                                               "<BatteryAbove level=\"0.94\"/>")},
    {"and nowhere else", steps("<DriveTo place=\"sofa\"/>" + fails("<Charge/>"))},
    {"driving takes charge: 100 m empty a battery",
     steps("<Charge level=\"1\"/><Repeat times=\"9\">" +
           steps("<DriveTo place=\"sofa\"/><DriveTo place=\"dock\"/>") + "</Repeat>" +
           fails("<BatteryAbove level=\"0.1\"/>") + "<DriveTo place=\"sofa\"/>" +
           fails("<Repeat times=\"2\">" +
                 steps("<DriveTo place=\"dock\"/><DriveTo place=\"sofa\"/>") + "</Repeat>"))},
};

TEST_CASE("the fetch robot's laws hold in every flat", "[plugins][fetch]") {
  for (const Law& law : kLaws) {
    INFO(law.law);
    const TreeRunner runner("fetch", law.nodes);
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      INFO("seed " << seed);
      const TreeRunEnd end = runner.run({.seed = seed});
      CHECK(end.fault == "");
      CHECK(end.status == Status::Success);
    }
  }
}

TEST_CASE("actions of the fetch robot take their time, at any rate", "[plugins][fetch]") {
  struct Row {
    std::string node;
    double seconds;
  };
  const Row rows[] = {
      {"<DriveTo place=\"sofa\" speed=\"0.5\"/>", 10.05},  // the sofa is at (5, 0.5)
      {"<MoveArm pose=\"reach\" speed=\"0.25\"/>", 4},
      {"<Say text=\"0123456789\" rate=\"5\"/>", 2},
      {"<LookFor object=\"mug\" seconds=\"3\"/>", 3},
  };
  for (const Row& row : rows) {
    const TreeRunner runner("fetch", row.node);
    for (const double rate : {20.0, 100.0, 1000.0}) {
      INFO(row.node << " at " << rate << " Hz");
      CHECK(runner.run({.rate = rate}).seconds == Approx(row.seconds).margin(2 / rate));
    }
  }
}

TEST_CASE("the progress of a drive rises evenly from 0 to 1", "[plugins][fetch]") {
  const TreeRunner runner("fetch", "<DriveTo place=\"sofa\"/>");
  std::vector<double> progress;
  const auto collect = [&](Ticker& ticker) { progress.push_back(ticker.progress(0)); };
  CHECK(runner.run({.after_tick = collect}).status == Status::Success);
  CHECK(std::is_sorted(progress.begin(), progress.end()));
  CHECK(progress.front() < 0.01);
  CHECK(progress[progress.size() / 2] == Approx(0.5).margin(0.01));
  CHECK(progress.back() == 1);
}

TEST_CASE("a name that does not exist is a fault that tells those that do", "[plugins][fetch]") {
  const TreeRunner runner("fetch", "<DriveTo place=\"kitchn\"/>");
  CHECK(runner.run().fault ==
        "there is no place 'kitchn', only dock, sofa, kitchen_door, "
        "office_door, kitchen, office, counter, table, desk, shelf");
}

}  // namespace
}  // namespace lockstep::host::test

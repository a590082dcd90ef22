// The plugin 'motion', compiled into the test: its leaves, tick by tick.
#include <catch2/catch.hpp>

#include "fake_host.h"
#include "lockstep/leaf.hpp"
#include "unit/document/temporary_directory.h"

#undef LOCKSTEP_PLUGIN
#define LOCKSTEP_PLUGIN(...) LOCKSTEP_PLUGIN_TABLE(motion_plugin, __VA_ARGS__)
#include "../../../plugins/motion/motion.cpp"
#include "../../../plugins/motion/profile.cpp"
#include "../../../plugins/motion/recorded.cpp"
#include "../../../plugins/motion/unpacked.cpp"

namespace {

const lockstep_leaf_type& kAdvance = *motion_plugin.leaf_types[0];
const lockstep_leaf_type& kProfile = *motion_plugin.leaf_types[1];
const lockstep_leaf_type& kRecorded = *motion_plugin.leaf_types[2];

using Numbers = std::vector<double>;

// The ports behind those that are given: what it reports is neither late nor in steps, and it
// obeys.
class MotionLeaf : public sdk_test::FakeLeaf {
 public:
  MotionLeaf(const lockstep_leaf_type& type, std::vector<sdk_test::PortValue> ports)
      : FakeLeaf(type, with_late_ports(std::move(ports))) {}

 private:
  static std::vector<sdk_test::PortValue> with_late_ports(std::vector<sdk_test::PortValue> ports) {
    ports.insert(ports.end(), {0.0, 0.0, true, 0.0, 0.0});
    return ports;
  }
};

MotionLeaf profile_of(Numbers points, const std::string& clock) {
  return MotionLeaf(kProfile, {std::string("line"), 0.001, std::move(points), clock});
}

// Starts the leaf and ticks it to its end; its progress before each tick.
std::vector<double> progress_to_success(MotionLeaf& leaf) {
  std::vector<double> progress;
  leaf.start();
  lockstep_status status = LOCKSTEP_RUNNING;
  while (status == LOCKSTEP_RUNNING && progress.size() < 2000) {
    progress.push_back(leaf.progress());
    status = leaf.tick();
  }
  CHECK(status == LOCKSTEP_SUCCESS);
  return progress;
}

}  // namespace

TEST_CASE("ten steps of 0.1 are one", "[sdk][motion]") {
  MotionLeaf advance(kAdvance, {0.1, 0.0, std::string("tick")});
  CHECK(progress_to_success(advance).size() == 10);
  CHECK(progress_to_success(advance).size() == 10);
}

TEST_CASE("Advance adds its step and its noise, and stays from 0 to 1", "[sdk][motion]") {
  MotionLeaf advance(kAdvance, {0.25, 0.5, std::string("tick")});
  // The fake host draws 0, 1/4, 2/4, 3/4, …: the changes are -0.25, 0, 0.25, 0.5.
  CHECK(progress_to_success(advance) == std::vector<double>{0, 0, 0, 0.25, 0.75, 0.5, 0.5, 0.75});
}

TEST_CASE("a step that is too large ends at 1", "[sdk][motion]") {
  MotionLeaf advance(kAdvance, {7.0, 0.0, std::string("tick")});
  advance.start();
  CHECK(advance.tick() == LOCKSTEP_SUCCESS);
  CHECK(advance.progress() == 1);
}

TEST_CASE("a line rises by its step", "[sdk][motion]") {
  MotionLeaf profile(kProfile, {std::string("line"), 0.25, Numbers(), std::string("ticks")});
  CHECK(progress_to_success(profile) == std::vector<double>{0, 0.25, 0.5, 0.75});
  CHECK(profile.progress() == 1);
}

TEST_CASE("a sigmoid takes as long as a line: slow, fast, slow", "[sdk][motion]") {
  MotionLeaf profile(kProfile, {std::string("sigmoid"), 0.001, Numbers(), std::string("ticks")});
  const auto progress = progress_to_success(profile);
  REQUIRE(progress.size() == 1000);
  CHECK(progress[0] == 0);
  CHECK(profile.progress() == 1);
  CHECK(progress[500] == Approx(0.5));
  CHECK(progress[100] < 0.05);
  CHECK(progress[900] == Approx(1 - progress[100]));
  for (std::size_t i = 1; i < progress.size(); ++i) CHECK(progress[i] > progress[i - 1]);
}

TEST_CASE("a profile refuses what it cannot follow", "[sdk][motion]") {
  MotionLeaf unknown(kProfile, {std::string("circle"), 0.1, Numbers(), std::string("ticks")});
  unknown.start();
  CHECK(unknown.host.take_error() == "port 'shape' is neither 'line' nor 'sigmoid'");
  const double step = GENERATE(0.0, -0.1, 1.5);
  MotionLeaf still(kProfile, {std::string("line"), step, Numbers(), std::string("ticks")});
  still.start();
  CHECK(still.host.take_error() == "port 'step' is not in (0, 1]");
}

TEST_CASE("noise_per=run draws once in the run, for a constant pace", "[sdk][motion]") {
  // The fake host draws 0, which is -1 times the noise.
  MotionLeaf advance(kAdvance, {0.5, 0.25, std::string("run")});
  CHECK(progress_to_success(advance) == Numbers{0, 0.25, 0.5, 0.75});
  CHECK(progress_to_success(advance) == Numbers{0, 0.25, 0.5, 0.75});
  CHECK(advance.host.draws == 1);
  MotionLeaf unknown(kAdvance, {0.5, 0.25, std::string("activation")});
  unknown.start();
  CHECK(unknown.host.take_error() == "port 'noise_per' is neither 'tick' nor 'run'");
}

TEST_CASE("a profile goes through its points, in straight lines", "[sdk][motion]") {
  MotionLeaf profile = profile_of({0, 0, 2, 0.5, 4, 0.25, 5, 1}, "ticks");
  CHECK(progress_to_success(profile) == Numbers{0, 0.25, 0.5, 0.375, 0.25});
  CHECK(profile.progress() == 1);
}

TEST_CASE("a profile by the time goes on while it is held", "[sdk][motion]") {
  MotionLeaf profile = profile_of({0, 0, 5, 0.2, 10, 1}, "time");
  profile.host.time = 100;
  profile.start();
  CHECK(profile.tick() == LOCKSTEP_RUNNING);
  CHECK(profile.progress() == 0);
  profile.host.time = 102.5;
  CHECK(profile.progress() == Approx(0.1));
  profile.host.time = 107.5;
  CHECK(profile.progress() == Approx(0.6));
  CHECK(profile.tick() == LOCKSTEP_RUNNING);
  profile.host.time = 200;
  CHECK(profile.progress() == 1);
  CHECK(profile.tick() == LOCKSTEP_SUCCESS);

  MotionLeaf line(kProfile, {std::string("line"), 2.0, Numbers(), std::string("time")});
  line.start();
  line.host.time = 0.25;
  CHECK(line.progress() == 0.5);
  line.host.time = 0.5;
  CHECK(line.tick() == LOCKSTEP_SUCCESS);
}

TEST_CASE("a profile refuses points that are no progress over time", "[sdk][motion]") {
  struct Row {
    Numbers points;
    std::string reason;
  };
  const Row row = GENERATE(values<Row>({
      {{0, 0, 1}, "is not a list of pairs: when, and the progress there"},
      {{0, 0, 2, 0.5, 1, 1}, "goes back in time"},
      {{-1, 0, 1, 1}, "goes back in time"},
      {{0, 0, 1, 0.5, 1, 1}, "has two points at one time"},
      {{0, 0, 1, 1.5, 2, 1}, "has a progress outside of [0, 1]"},
      {{0, 0, 1, 0.5}, "does not end at progress 1"},
  }));
  MotionLeaf profile = profile_of(row.points, "ticks");
  profile.start();
  CHECK(profile.host.take_error() == "port 'points' " + row.reason);
  MotionLeaf clock = profile_of({}, "wall");
  clock.start();
  CHECK(clock.host.take_error() == "port 'clock' is neither 'ticks' nor 'time'");
}

namespace {

constexpr const char* kHeader =
    R"({"lockstep_recording":1,"nodes":[{"path":"T/p"},{"path":"T/p/a"},{"path":"T/p/b"}]})";

class RecordedFile {
 public:
  explicit RecordedFile(const std::string& lines) : path_(directory_ / "run.jsonl") {
    directory_.write("run.jsonl", std::string(kHeader) + "\n" + lines);
  }
  MotionLeaf leaf(const std::string& node, const std::string& clock = "ticks") const {
    return MotionLeaf(kRecorded, {path_, node, clock});
  }
  std::string error(const std::string& node) const {
    MotionLeaf it = leaf(node);
    const std::string error = it.host.take_error();
    CHECK(it.exists() == error.empty());
    return error.substr(std::min(error.size(), path_.size() + 2));  // behind the name of the file
  }

 private:
  lockstep::host::TemporaryDirectory directory_;
  std::string path_;
};

constexpr const char* kTicks = R"({"tick":0,"time_s":0.0,"nodes":[[0,"running",0,1,0]]}
{"tick":1,"time_s":0.1,"nodes":[[1,"running",0,1,0],[2,"running",0,1,0]]}
{"tick":2,"time_s":0.2,"nodes":[[1,"running",0.5,1,0],[2,"failure",0.25,1,0]]}
{"tick":3,"time_s":0.3,"nodes":[]}
{"lost":{"ticks":1,"from":4}}
{"tick":5,"time_s":0.5,"nodes":[[1,"success",0.75,1,0],[2,"idle",0,0,0]]}
{"end":{"result":"success"}}
)";

}  // namespace

TEST_CASE("a recorded node is played tick by tick, to the end that it had", "[sdk][motion]") {
  const RecordedFile file(kTicks);
  MotionLeaf a = file.leaf("T/p/a");
  CHECK(progress_to_success(a) == Numbers{0, 0.5, 0.5, 0.625, 0.75});
  CHECK(progress_to_success(a) == Numbers{0, 0.5, 0.5, 0.625, 0.75});
  MotionLeaf b = file.leaf("T/p/b");
  b.start();
  CHECK(b.tick() == LOCKSTEP_RUNNING);
  CHECK(b.progress() == 0.25);
  CHECK(b.tick() == LOCKSTEP_FAILURE);
  MotionLeaf p = file.leaf("T/p");
  p.start();
  for (int tick = 0; tick < 100; ++tick) CHECK(p.tick() == LOCKSTEP_RUNNING);
}

TEST_CASE("a recorded node is played by the time that it took", "[sdk][motion]") {
  const RecordedFile file(kTicks);
  MotionLeaf a = file.leaf("T/p/a", "time");
  a.host.time = 7;
  a.start();
  CHECK(a.tick() == LOCKSTEP_RUNNING);
  a.host.time = 7.05;
  CHECK(a.progress() == Approx(0.25));
  a.host.time = 7.39;
  CHECK(a.tick() == LOCKSTEP_RUNNING);
  a.host.time = 7.4;
  CHECK(a.progress() == Approx(0.75));
  CHECK(a.tick() == LOCKSTEP_SUCCESS);
}

TEST_CASE("a recording that is cut is played as far as it goes", "[sdk][motion]") {
  const std::string ticks(kTicks);
  const RecordedFile file(ticks.substr(0, ticks.find("[2,\"failure")));
  MotionLeaf a = file.leaf("T/p/a");
  a.start();
  for (int tick = 0; tick < 10; ++tick) CHECK(a.tick() == LOCKSTEP_RUNNING);
  CHECK(a.progress() == 0);
}

TEST_CASE("what is no recording is refused, with its line", "[sdk][motion]") {
  const std::string ticks(kTicks);
  const auto error = [](const std::string& lines) { return RecordedFile(lines).error("T/p/a"); };
  CHECK(RecordedFile(ticks).error("T/p/c") ==
        ":1: the recording has no node 'T/p/c'; lockstep log csv prints their paths");
  CHECK(error("") == ":1: the node 'T/p/a' never ran");
  CHECK(error("nonsense\n" + ticks) == ":2: not JSON");
  CHECK(error("{}\n" + ticks) == ":2: not a line of a recording");
  CHECK(error(R"({"tick":0,"time_s":0,"nodes":[[1,"running",7,1,0]]})") ==
        ":2: not a line of a recording");
  CHECK(error(ticks.substr(0, ticks.find("{\"lost")) + ticks) ==
        ":6: a tick that does not come after the one before");
  MotionLeaf missing(kRecorded,
                     {std::string("/nowhere.jsonl"), std::string("T/p"), std::string("ticks")});
  CHECK(missing.host.take_error() == "'/nowhere.jsonl': cannot be read");
  MotionLeaf endless(kRecorded,
                     {std::string("/dev/zero"), std::string("T/p"), std::string("ticks")});
  CHECK(endless.host.take_error() == "'/dev/zero': cannot be read");
}

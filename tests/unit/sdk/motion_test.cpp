// The plugin 'motion', compiled into the test: its leaves, tick by tick.
#include <catch2/catch.hpp>

#include "fake_host.h"
#include "lockstep/leaf.hpp"

#undef LOCKSTEP_PLUGIN
#define LOCKSTEP_PLUGIN(...) LOCKSTEP_PLUGIN_TABLE(motion_plugin, __VA_ARGS__)
#include "../../../plugins/motion/motion.cpp"

namespace {

using sdk_test::FakeLeaf;

const lockstep_leaf_type& kAdvance = *motion_plugin.leaf_types[0];
const lockstep_leaf_type& kProfile = *motion_plugin.leaf_types[1];

// Starts the leaf and ticks it to its end; its progress before each tick.
std::vector<double> progress_to_success(FakeLeaf& leaf) {
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
  FakeLeaf advance(kAdvance, {0.1, 0.0});
  CHECK(progress_to_success(advance).size() == 10);
  CHECK(progress_to_success(advance).size() == 10);
}

TEST_CASE("Advance adds its step and its noise, and stays from 0 to 1", "[sdk][motion]") {
  FakeLeaf advance(kAdvance, {0.25, 0.5});
  // The fake host draws 0, 1/4, 2/4, 3/4, …: the changes are -0.25, 0, 0.25, 0.5.
  CHECK(progress_to_success(advance) == std::vector<double>{0, 0, 0, 0.25, 0.75, 0.5, 0.5, 0.75});
}

TEST_CASE("a step that is too large ends at 1", "[sdk][motion]") {
  FakeLeaf advance(kAdvance, {7.0, 0.0});
  advance.start();
  CHECK(advance.tick() == LOCKSTEP_SUCCESS);
  CHECK(advance.progress() == 1);
}

TEST_CASE("a line rises by its step", "[sdk][motion]") {
  FakeLeaf profile(kProfile, {std::string("line"), 0.25});
  CHECK(progress_to_success(profile) == std::vector<double>{0, 0.25, 0.5, 0.75});
  CHECK(profile.progress() == 1);
}

TEST_CASE("a sigmoid takes as long as a line: slow, fast, slow", "[sdk][motion]") {
  FakeLeaf profile(kProfile, {std::string("sigmoid"), 0.001});
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
  FakeLeaf unknown(kProfile, {std::string("circle"), 0.1});
  unknown.start();
  CHECK(unknown.host.take_error() == "port 'shape' is neither 'line' nor 'sigmoid'");
  const double step = GENERATE(0.0, -0.1, 1.5);
  FakeLeaf still(kProfile, {std::string("line"), step});
  still.start();
  CHECK(still.host.take_error() == "port 'step' is not in (0, 1]");
}

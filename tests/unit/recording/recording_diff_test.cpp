// Two recordings against each other: one difference, planted anywhere, is found and nothing else.
#include <catch2/catch.hpp>
#include <sstream>

#include "record/use/recording_diff.h"
#include "unit/recording/random_recording.h"

namespace lockstep::host {
namespace {

using test::random_recording;
using test::RandomRecording;

RecordingDiff diff_of(const std::string& a, const std::string& b, const DiffOptions& options = {}) {
  std::istringstream in_a(a), in_b(b);
  RecordingReader reader_a(in_a, "a.jsonl"), reader_b(in_b, "b.jsonl");
  RecordingDiff diff = compare(reader_a, reader_b, options);
  CHECK(reader_a.error() == "");
  CHECK(reader_b.error() == "");
  return diff;
}

TEST_CASE("a recording is the same as itself") {
  std::mt19937 random(0);
  const std::string text = random_recording(random).text();
  const RecordingDiff diff = diff_of(text, text);
  CHECK(diff.same());
  CHECK(to_text(diff, "a", "b", false) == "");
}

TEST_CASE("a state that differs is found in its tick and its node, wherever it is") {
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    const RandomRecording one = random_recording(random);
    RandomRecording other = one;
    const std::size_t place = random() % one.ticks.size();
    const std::size_t node = random() % one.header.nodes.size();
    RecordedState& planted = other.ticks[place].nodes[node];
    planted = test::other_state(random, planted);
    // What differs later is not told.
    for (std::size_t later = place + 1; later < one.ticks.size(); ++later) {
      other.ticks[later].nodes[random() % one.header.nodes.size()] = planted;
    }
    const RecordingDiff diff = diff_of(one.text(), other.text());
    CAPTURE(seed, place, node);
    REQUIRE(diff.tick);
    CHECK(diff.tick->tick == one.ticks[place].tick);
    CHECK(diff.tick->missing == TickDifference::Missing::None);
    REQUIRE(diff.tick->nodes.size() == 1);
    CHECK(diff.tick->nodes[0].path == one.header.nodes[node].path);
    CHECK(diff.tick->nodes[0].a == one.ticks[place].nodes[node]);
    CHECK(diff.tick->nodes[0].b == planted);
    CHECK(diff.header.empty());
    CHECK(diff.end.empty());
    CHECK(diff.ticks_a == diff.ticks_b);
    CHECK(!diff.same());
  }
}

// Its process does not know the limit of a node that it has not ticked.
TEST_CASE("a run that was cut has the limits of one that was not") {
  const auto header = [](const std::string& more) {
    return R"({"lockstep_recording":1,"tree":"T","file":"a.xml","version":"1","law":3,)"
           R"("rate_hz":10.0,"clock":"virtual","seed":0,"arguments":{},"nodes":[)"
           R"({"index":0,"path":"T/s","kind":"Sequence","name":"s","parent":null},)"
           R"({"index":1,"path":"T/s/p","kind":"ParallelAbsolute","name":"p","parent":0,)"
           R"("barriers":[0.5]},)"
           R"({"index":2,"path":"T/s/p/a","kind":"A","name":"a","parent":1},)"
           R"({"index":3,"path":"T/s/w","kind":"Wait","name":"w","parent":0}])" +
           more + "}\n";
  };
  const std::string first =
      R"({"tick":0,"time_s":0.0,"nodes":[[0,"running",0,1,0],[1,"success",0,1,0],)"
      R"([2,"success",1,1,0],[3,"running",0,1,0]],"limits":[[1,null]]})"
      "\n";
  const std::string whole = header("") + first +
                            R"({"tick":1,"time_s":0.1,"nodes":[[1,"success",0,0,0],)"
                            R"([2,"success",1,0,0],[3,"running",0.5,1,0]]})"
                            "\n";
  const std::string cut = header("") + first + "{\"continued\":{\"ticks\":1}}\n" +
                          header(R"(,"first_tick":1,"resumed_after_s":2.0)") +
                          R"({"tick":1,"time_s":0.1,"nodes":[[0,"running",0,1,0],)"
                          R"([1,"success",0,0,0],[2,"success",1,0,0],[3,"running",0.5,1,0]],)"
                          R"("whole":[]})"
                          "\n";
  const RecordingDiff diff = diff_of(whole, cut);
  INFO(to_text(diff, "a", "b", false));
  CHECK(!diff.tick);
}

TEST_CASE("times, faults and lost ticks differ too") {
  std::mt19937 random(5);
  const RandomRecording one = random_recording(random, {.gaps = false});
  RandomRecording time = one, fault = one, lost = one;
  time.ticks[7].time += 1e-9;
  const RecordingDiff in_time = diff_of(one.text(), time.text());
  REQUIRE(in_time.tick);
  CHECK(in_time.tick->tick == 7);
  CHECK(in_time.tick->time_a != in_time.tick->time_b);
  CHECK(diff_of(one.text(), time.text(), {.ignore_time = true}).same());

  fault.ticks[9].faults = {{2, "broke"}};
  const RecordingDiff in_fault = diff_of(one.text(), fault.text());
  REQUIRE(in_fault.tick);
  CHECK(in_fault.tick->tick == 9);
  CHECK(in_fault.tick->faults_b == std::vector<std::string>{"Main/root/2: broke"});

  lost.ticks.erase(lost.ticks.begin() + 11);
  lost.ticks[11].lost = 1;
  const RecordingDiff in_b = diff_of(one.text(), lost.text());
  REQUIRE(in_b.tick);
  CHECK(in_b.tick->tick == 11);
  CHECK(in_b.tick->missing == TickDifference::Missing::InB);
  CHECK(in_b.tick->lost);
  CHECK(diff_of(lost.text(), one.text()).tick->missing == TickDifference::Missing::InA);
  CHECK(to_text(in_b, "a", "b", false) ==
        "--- a\n+++ b\n@@ tick 11 @@\n-recorded\n+lost\n@@ length @@\n-60 ticks\n+59 ticks\n"
        "@@ end @@\n-lost 0\n+lost 1\n");
}

TEST_CASE("progress within the tolerance is the same, a status never") {
  std::mt19937 random(6);
  RandomRecording one = random_recording(random);
  one.ticks[3].nodes[1] = {.progress = 0.5, .status = Status::Running};
  RandomRecording other = one;
  other.ticks[3].nodes[1].progress = 0.75;
  CHECK(!diff_of(one.text(), other.text()).same());
  CHECK(!diff_of(one.text(), other.text(), {.tolerance = 0.2}).same());
  CHECK(diff_of(one.text(), other.text(), {.tolerance = 0.25}).same());
  other.ticks[3].nodes[1].status = Status::Success;
  CHECK(!diff_of(one.text(), other.text(), {.tolerance = 1}).same());
}

TEST_CASE("what differs in the headers and the ends, names and versions do not count") {
  std::mt19937 random(7);
  RandomRecording one = random_recording(random, {.ticks = 3, .gaps = false});
  one.header.arguments = {{"x", "1"}, {"y", "2"}};
  RandomRecording other = one;
  other.header.file = "elsewhere.xml";
  other.header.version = "0.2.0";
  const RecordingDiff same = diff_of(one.text(), other.text());
  CHECK(same.same());
  CHECK(same.notes == std::vector<std::string>{"recorded by lockstep 0.1.0 and by lockstep 0.2.0"});
  other.header.seed = 9;
  other.header.arguments = {{"x", "3"}, {"z", "4"}};
  other.end.result = "success";
  other.end.fault = "Main: broke";
  CHECK(to_text(diff_of(one.text(), other.text()), "a", "b", false) ==
        "--- a\n"
        "+++ b\n"
        " note: recorded by lockstep 0.1.0 and by lockstep 0.2.0\n"
        "@@ header @@\n"
        "-seed 0\n"
        "+seed 9\n"
        "-argument x 1\n"
        "+argument x 3\n"
        "-argument y 2\n"
        "+argument z 4\n"
        "@@ end @@\n"
        "-result stopped\n"
        "+result success\n"
        "+fault Main: broke\n");
}

TEST_CASE("of different trees the nodes with the same path are compared") {
  std::mt19937 random(8);
  const RandomRecording one = random_recording(random, {.nodes = 4, .ticks = 9});
  RandomRecording other = one;
  // Another node before the others, as when the tree was edited.
  other.header.nodes.insert(other.header.nodes.begin() + 1, other.header.nodes[3]);
  other.header.nodes[1].path = "Main/root/new";
  other.header.nodes[2].kind = "Wait";
  for (TimelineTick& moment : other.ticks) {
    moment.nodes.insert(moment.nodes.begin() + 1, RecordedState{});
    for (RecordedFault& fault : moment.faults) fault.node += fault.node > 0;
  }
  const RecordingDiff diff = diff_of(one.text(), other.text());
  CHECK(!diff.tick);
  REQUIRE(diff.header.size() == 2);
  CHECK(diff.header[0].what == "node Main/root/1");
  CHECK(*diff.header[0].b == "Wait");
  CHECK(diff.header[1].what == "node Main/root/new");
  CHECK(!diff.header[1].a);
  other.ticks[4].nodes[3].progress = 0.12345;
  const RecordingDiff in_tick = diff_of(one.text(), other.text());
  REQUIRE(in_tick.tick);
  CHECK(in_tick.tick->nodes[0].path == "Main/root/2");
  for (ShapeNode& node : other.header.nodes) node.path = "Other" + node.path;
  CHECK(!diff_of(one.text(), other.text()).has_common_nodes);
}

TEST_CASE("a recording that ends before another differs from it there") {
  std::mt19937 random(9);
  const RandomRecording one = random_recording(random, {.ticks = 10, .gaps = false});
  std::string text = one.text();
  const RecordingDiff diff = diff_of(one.text(), text.substr(0, text.find("{\"tick\":6,")));
  REQUIRE(diff.tick);
  CHECK(diff.tick->tick == 6);
  CHECK(diff.tick->missing == TickDifference::Missing::InB);
  CHECK(!diff.tick->lost);
  CHECK(diff.ticks_b == 6);
  CHECK(diff.end.front().what == "result");
  CHECK(!diff.end.front().b);
}

}  // namespace
}  // namespace lockstep::host

// The hallway scene of plugins/r1sim: head and base do what the experiment needs of them, and it
// shows what it is to show.
#include <catch2/catch.hpp>

#include "unit/plugins/tree_run.h"

namespace lockstep::host::test {
namespace {

std::string seek(const std::string& parallel, const std::string& hallway = "",
                 const std::string& swipe = "", const std::string& may_miss = "0") {
  return "<Sequence memory=\"true\"><EnterHallway " + hallway + "/><" + parallel +
         "><Swipe name=\"head\" " + swipe + "/><Navigate name=\"base\"/></" +
         parallel.substr(0, parallel.find(' ')) + "><MissedAtMost count=\"" + may_miss +
         "\"/></Sequence>";
}
std::string barriers(const std::string& count) {
  return "ParallelAbsolute barrier_count=\"" + count + "\"";
}
std::string delta(const std::string& value) {
  return "ParallelRelative delta=\"" + value + "\"";
}

int missed(const std::string& parallel, double rate = 100) {
  const TreeRunner runner("r1sim", seek(parallel));
  int count = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TreeRunEnd end = runner.run({.seed = seed, .rate = rate});
    CHECK(end.fault.empty());
    CHECK((end.status == Status::Success) == end.log.empty());
    count += static_cast<int>(end.log.size());
  }
  return count;
}

TEST_CASE("objects are missed unless head and base are in step, at any rate", "[plugins][r1sim]") {
  for (const double rate : {50.0, 100.0, 400.0}) {
    INFO("at " << rate << " Hz");
    CHECK(missed(barriers("20"), rate) == 0);
    CHECK(missed(delta("0.05"), rate) == 0);
    CHECK(missed(barriers("0"), rate) > 20 * 3);
    CHECK(missed(delta("1"), rate) == missed(barriers("0"), rate));
  }
}

TEST_CASE("the more barriers, and the smaller delta, the fewer are missed", "[plugins][r1sim]") {
  CHECK(missed(barriers("2")) < missed(barriers("0")));
  CHECK(missed(barriers("5")) < missed(barriers("2")));
  CHECK(missed(delta("0.2")) <= missed(delta("1")));
  CHECK(missed(delta("0.1")) < missed(delta("0.2")));
}

TEST_CASE("an empty hallway takes its length over the speeds, at any rate", "[plugins][r1sim]") {
  const TreeRunner base("r1sim",
                        "<Sequence memory=\"true\"><EnterHallway objects=\"0\" "
                        "length=\"3\"/><Navigate speed=\"0.5\"/></Sequence>");
  const TreeRunner head("r1sim",
                        "<Sequence memory=\"true\"><EnterHallway objects=\"0\" "
                        "length=\"3\"/><Swipe speed=\"0.75\"/></Sequence>");
  for (const double rate : {20.0, 100.0, 1000.0}) {
    CHECK(base.run({.rate = rate}).seconds == Approx(6).margin(3 / rate));
    CHECK(head.run({.rate = rate}).seconds == Approx(4).margin(3 / rate));
  }
}

TEST_CASE("the head stops for each object as long as its identification takes",
          "[plugins][r1sim]") {
  const TreeRunner runner(
      "r1sim",
      "<Sequence memory=\"true\"><EnterHallway objects=\"7\" identify_min=\"2\" "
      "identify_max=\"2\"/><Swipe name=\"head\" reach=\"99\"/></Sequence>");
  const NodeIndex head = runner.node("head");
  double standing = 0;
  double before = -1;
  const auto measure = [&](Ticker& ticker) {
    if (ticker.status(head) != Status::Running) return;
    standing += ticker.progress(head) == before ? 0.01 : 0;
    before = ticker.progress(head);
  };
  const TreeRunEnd end = runner.run({.seed = 5, .after_tick = measure});
  CHECK(end.seconds == Approx(10 / 0.5 + 7 * 2).margin(0.03));
  CHECK(standing == Approx(7 * 2).margin(7 * 0.02));
}

TEST_CASE("head and base stand still while they are held, and only the head otherwise",
          "[plugins][r1sim]") {
  const TreeRunner runner("r1sim", seek(barriers("20")));
  const NodeIndex nodes[] = {runner.node("head"), runner.node("base")};
  double before[] = {0, 0};
  bool was_held[] = {true, true};
  int held[] = {0, 0};
  const auto look = [&](Ticker& ticker) {
    for (const int i : {0, 1}) {
      if (ticker.status(nodes[i]) != Status::Running) continue;
      const double now = ticker.progress(nodes[i]);
      if (was_held[i] && ticker.held(nodes[i])) CHECK(now == before[i]);
      if (i == 1 && !was_held[i] && now < 1) CHECK(now > before[i]);
      held[i] += ticker.held(nodes[i]);
      was_held[i] = ticker.held(nodes[i]);
      before[i] = now;
    }
  };
  CHECK(runner.run({.after_tick = look}).status == Status::Success);
  CHECK(held[0] > 100);
  CHECK(held[1] > 100);
}

TEST_CASE("an object is missed that is out of the head's reach", "[plugins][r1sim]") {
  const std::string objects = "objects=\"6\"";
  const auto result = [&](const std::string& swipe, const std::string& may_miss) {
    const TreeRunner runner("r1sim", seek(barriers("0"), objects, swipe, may_miss));
    return runner.run({.seed = 1}).status;
  };
  CHECK(result("reach=\"99\"", "0") == Status::Success);
  CHECK(result("reach=\"0\"", "5") == Status::Failure);
  CHECK(result("reach=\"0\"", "6") == Status::Success);
}

TEST_CASE("a hallway must be there, and be one", "[plugins][r1sim]") {
  const std::string rows[][2] = {
      {"<Swipe/>", "there is no hallway: 'EnterHallway' must come first"},
      {"<Navigate/>", "there is no hallway: 'EnterHallway' must come first"},
      {"<MissedAtMost/>", "there is no hallway: 'EnterHallway' must come first"},
      {"<EnterHallway length=\"0\"/>", "port 'length' must be greater than 0"},
      {"<EnterHallway identify_min=\"5\"/>",
       "ports 'identify_min' and 'identify_max' are no interval of times"},
  };
  for (const auto& [node, message] : rows) {
    CHECK(TreeRunner("r1sim", node).run().fault == message);
  }
}

TEST_CASE("a second search begins at the start of the hallway", "[plugins][r1sim]") {
  const TreeRunner once("r1sim", seek(barriers("20")));
  const TreeRunner twice("r1sim", "<Repeat times=\"2\">" + seek(barriers("20")) + "</Repeat>");
  const TreeRunEnd end = twice.run({.seed = 2});
  CHECK(end.status == Status::Success);
  CHECK(end.seconds > 1.5 * once.run({.seed = 2}).seconds);
  const std::string blind = seek(barriers("0"), "objects=\"6\"", "reach=\"0\"", "6");
  const TreeRunner misses("r1sim", "<Repeat times=\"2\">" + blind + "</Repeat>");
  CHECK(misses.run().status == Status::Success);
}

TEST_CASE("the same seed gives the same hallway, synchronized or not", "[plugins][r1sim]") {
  const auto seconds = [](const std::string& parallel, std::uint64_t seed) {
    return TreeRunner("r1sim", seek(parallel, "", "reach=\"99\"")).run({.seed = seed}).seconds;
  };
  CHECK(seconds(barriers("20"), 3) == seconds(barriers("20"), 3));
  CHECK(seconds(barriers("20"), 3) != seconds(barriers("20"), 4));
}

}  // namespace
}  // namespace lockstep::host::test

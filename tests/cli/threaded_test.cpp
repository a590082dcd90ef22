// Threaded leaves on the virtual clock: they sleep in the run's time, and a run is the same every
// time.
#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>

#include "support/program.h"

namespace lockstep::host::test {
namespace {

const std::string kPlugin = LOCKSTEP_BINARY_DIR "/tests/cli/threaded.so";

class Threaded {
 public:
  explicit Threaded(const std::string& nodes) {
    tree_ = directory_.file("tree.xml",
                            "<root lockstep=\"1\"><plugin name=\"motion\"/>"
                            "<BehaviorTree ID=\"Main\">" +
                                nodes + "</BehaviorTree></root>");
  }
  Outcome run(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"run", tree_, "--plugin", kPlugin});
    if (std::ranges::find(more, "--clock") == more.end()) {
      more.insert(more.end(), {"--clock", "virtual"});
    }
    return run_lockstep(more);
  }
  std::string recorded(const std::vector<std::string>& more = {}) const {
    const std::string path = directory_.path("r.jsonl");
    std::vector<std::string> all{"--record", path, "--view", "none"};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = run(all);
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    std::string text = read_file(path);
    return text.substr(text.find('\n'));  // the first line has the time of day
  }
  const std::string& tree() const { return tree_; }

 private:
  TemporaryDirectory directory_;
  std::string tree_;
};

std::string said_by(const Outcome& outcome) {
  INFO(outcome.out << outcome.err);
  CHECK_FALSE(contains(outcome.err, "warning"));
  return outcome.out + outcome.err;
}

std::string without_logs(const std::string& recording) {
  std::istringstream lines(recording);
  std::string all;
  for (std::string line; std::getline(lines, line);) {
    const auto logs = line.find(",\"logs\":");
    const char* const end = line.starts_with("{\"end\"") ? "}}" : "}";
    all += (logs == std::string::npos ? line : line.substr(0, logs) + end) + "\n";
  }
  return all;
}

}  // namespace

TEST_CASE("a sleep without end lasts on both clocks, and one of no time ends at once") {
  for (const char* clock : {"virtual", "wall"}) {
    for (const char* seconds : {"1e10", "1e12", "1e300"}) {
      const Threaded tree(std::string(R"(<Sleeps steps="1" seconds=")") + seconds + "\"/>");
      const Outcome outcome = tree.run({"--clock", clock, "--max-ticks", "20"});
      INFO(clock << ' ' << seconds << outcome.err);
      CHECK(outcome.code == 124);
    }
    const Threaded tree(R"(<Sleeps steps="1" seconds="-1e300"/>)");
    CHECK(tree.run({"--clock", clock, "--timeout", "10"}).code == 0);
  }
}

TEST_CASE("on the virtual clock a threaded leaf sleeps in the time of the run") {
  const Outcome outcome = Threaded("<Sleeps steps=\"10\" seconds=\"60\"/>").run({"--rate", "10"});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err + outcome.out, "success after 6001 ticks, 600.100 s"));
  CHECK_FALSE(contains(outcome.err, "warning"));
  CHECK(outcome.cpu_seconds < 10);
}

TEST_CASE("on the virtual clock each yield of a threaded leaf waits for the next tick") {
  const Threaded it("<Yields times=\"100\"/>");
  for (const std::string rate : {"1", "10", "30", "1000"}) {
    INFO(rate);
    CHECK(contains(said_by(it.run({"--rate", rate})), "success after 101 ticks"));
  }
  CHECK(contains(said_by(it.run({"--isolate"})), "success after 101 ticks"));
  const Outcome halted =
      Threaded("<Timeout seconds=\"1\"><Yields times=\"1000\"/></Timeout>").run();
  CHECK(contains(said_by(halted), "failure after 101 ticks"));
}

TEST_CASE("a sleep of one period ends in the next tick, also where times are rounded") {
  const Threaded it("<Sleeps steps=\"300\" seconds=\"0.1\"/>");
  CHECK(contains(said_by(it.run({"--rate", "10"})), "success after 301 ticks"));
}

TEST_CASE("threaded leaves are held, and a run gives the same bytes every time") {
  const Threaded it(
      "<ParallelAbsolute barriers=\"0.25;0.5;0.75\"><Sleeps name=\"a\" steps=\"20\" "
      "seconds=\"0.03\"/><Sleeps name=\"b\" steps=\"8\" seconds=\"0.05\"/>"
      "<Advance name=\"c\" step=\"0.004\" noise=\"0.003\"/></ParallelAbsolute>");
  const std::string first = it.recorded();
  CHECK(contains(first, "step 19"));
  CHECK(contains(first, ",0,1]"));  // not ticked, held
  for (int again = 0; again < 5; ++again) CHECK(it.recorded() == first);
  // The lines of an isolated plugin come when they come; all else is as in this process.
  CHECK(without_logs(it.recorded({"--isolate"})) == without_logs(first));
}

TEST_CASE("an isolated threaded leaf takes the ticks that it takes in this process") {
  for (
      const char* nodes :
      {R"(<Sleeps steps="1" seconds="0"/>)", R"(<Sleeps steps="5" seconds="0"/>)",
       R"(<Yields times="0"/>)", R"(<Sleeps steps="3" seconds="-1"/>)",
       R"(<ParallelAbsolute barriers="0.5"><Sleeps name="a" steps="4" seconds="0"/>
           <Sleeps name="b" steps="2" seconds="0.0499"/></ParallelAbsolute>)",
       R"(<Sequence memory="true"><ParallelRelative delta="0"><Sleeps name="a" steps="5"
           seconds="0.01"/><Sleeps name="b" steps="2" seconds="0"/><Advance step="0.1"/>
           </ParallelRelative><Yields times="3"/></Sequence>)",
       R"(<ForceSuccess><Retry attempts="2"><Timeout seconds="0.05"><Parallel><Sleeps name="a" steps="9"
           seconds="0.01"/><Yields times="0"/></Parallel></Timeout></Retry></ForceSuccess>)"}) {
    INFO(nodes);
    const Threaded it(nodes);
    CHECK(without_logs(it.recorded({"--isolate"})) == without_logs(it.recorded()));
  }
}

TEST_CASE("a threaded leaf that is halted ends at once in the time of the run") {
  const Outcome outcome =
      Threaded("<Timeout seconds=\"1\"><Sleeps seconds=\"3600\"/></Timeout>").run();
  CHECK(outcome.code == 1);
  CHECK(contains(outcome.out + outcome.err, "failure after 101 ticks"));
  CHECK(outcome.cpu_seconds < 5);
}

TEST_CASE("what a threaded leaf throws is its fault in the tick after") {
  const Outcome outcome = Threaded("<Parallel><Sleeps/><Throws/></Parallel>").run();
  CHECK(outcome.code == 5);
  CHECK(contains(outcome.err, "the planner is gone"));
  CHECK(contains(outcome.err, "in tick 4"));
}

TEST_CASE("a worker that blocks elsewhere is named after the hang limit") {
  const Threaded it("<Sequence><Sleeps steps=\"1\"/><Blocks name=\"plan\"/></Sequence>");
  const Outcome outcome = it.run({"--hang-limit", "0.3"});
  CHECK(outcome.code == 6);
  CHECK(contains(outcome.err, "'Main/Sequence/plan' (Blocks of plugin 'threaded')"));
  const std::string backtrace = outcome.err.substr(outcome.err.find("lockstep: backtrace:\n"));
  CHECK(contains(backtrace, "/threaded.so("));  // of the thread that blocks
  CHECK(contains(outcome.err, "run"));
}

TEST_CASE("a study may have threaded leaves, and is the same on any number of threads") {
  const Threaded it(
      "<ParallelRelative delta=\"0.2\"><Sleeps name=\"a\"/><Advance name=\"b\" step=\"0.02\" "
      "noise=\"0.01\"/></ParallelRelative>");
  const TemporaryDirectory directory;
  std::vector<std::string> results;
  for (const std::string jobs : {"1", "2"}) {
    const std::string out = directory.path("study" + jobs);
    const Outcome outcome = run_lockstep(
        {"study", it.tree(), "--plugin", kPlugin, "--runs", "40", "--jobs", jobs, "--out", out});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK_FALSE(contains(outcome.err, "warning"));
    results.push_back(read_file(out + "/runs.csv"));
  }
  CHECK(results[0] == results[1]);
}

}  // namespace lockstep::host::test

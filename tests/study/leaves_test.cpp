// `lockstep study --leaves`: each run is the one that `lockstep run --leaves` makes with its seed.
#include <catch2/catch.hpp>
#include <set>

#include "study/study_case.h"

namespace lockstep::host::test {
namespace {

// Its leaves are those of no plugin.
const std::string kTree =
    "<root lockstep=\"1\"><arg name=\"barriers\" default=\"0.5\"/><BehaviorTree ID=\"T\">"
    "<ParallelAbsolute barriers=\"${barriers}\"><Lift/><Drive/></ParallelAbsolute>"
    "</BehaviorTree></root>";
const std::string kLeaves =
    "<leaves lockstep=\"1\" rate=\"20\"><leaf path=\"*\" step=\"0..1\"/>"
    "<leaf of=\"Lift\" ticks=\"2..9\"/></leaves>";

}  // namespace

TEST_CASE("a study with --leaves: each row is what run --leaves does with its seed") {
  const StudyCase it;
  const std::string tree = it.file("t.xml", kTree), leaves = it.file("t.leaves.xml", kLeaves);
  it.make({tree, "--leaves", leaves, "--runs", "12", "--grid", "barriers=0.5,0.25;0.75",
           "--measure", "duration", "--jobs", "2"},
          "out");
  const std::string csv = it.read("out", "runs.csv");
  CHECK(contains(it.read("out", "study.json"), "\"rate\": 20"));
  std::set<std::string> outcomes;
  const auto rows = lines(csv);
  REQUIRE(rows.size() == 1 + 24);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto row = fields(rows[i]);  // cell, barriers, run, seed, ticks, result, duration
    const Outcome run =
        run_lockstep({"run", tree, "--leaves", leaves, "--clock", "virtual", "--view", "none",
                      "--arg", "barriers=" + row[1], "--seed", row[3], "--json"});
    INFO(rows[i] << '\n' << run.out << run.err);
    CHECK(contains(run.out, "\"ticks\":" + row[4]));
    CHECK(run.code == (row[5] == "success" ? 0 : 1));
    outcomes.insert(row[4] + row[5]);
  }
  CHECK(outcomes.size() > 5);
}

TEST_CASE("a study with --leaves: the same on one thread and several, and after a change refused") {
  const StudyCase it;
  const std::string tree = it.file("t.xml", kTree), leaves = it.file("t.leaves.xml", kLeaves);
  const std::vector<std::string> study{tree, "--leaves", leaves, "--runs", "50"};
  const auto with = [&](const std::string& option, const std::string& value) {
    auto arguments = study;
    arguments.insert(arguments.end(), {option, value});
    return arguments;
  };
  it.make(with("--jobs", "1"), "one");
  it.make(with("--jobs", "3"), "three");
  CHECK(it.bytes("one") == it.bytes("three"));
  it.make(with("--rate", "50"), "fast");
  CHECK(contains(it.read("fast", "study.json"), "\"rate\": 50"));
  static_cast<void>(it.file("t.leaves.xml", kLeaves + "\n"));
  auto again = study;
  again.push_back("--resume");
  CHECK(it.study(again, "one").code == 2);
}

TEST_CASE(
    "a study with --leaves: a script is each run, as long as it is, and a wrong file is refused") {
  const StudyCase it;
  const std::string tree = it.file("t.xml", kTree);
  const auto study = [&](const std::string& script) {
    return it.study({tree, "--leaves", it.file("t.leaves", script), "--runs", "3"}, "out");
  };
  CHECK(study("@rate 5\n@ticks 4\nT/ParallelAbsolute/Lift = R0.5 S\n").code == 0);
  const auto rows = lines(it.read("out", "runs.csv"));
  REQUIRE(rows.size() == 4);
  for (std::size_t i = 1; i < rows.size(); ++i) CHECK(contains(rows[i], ",4,limit,"));
  const Outcome other = study("T/Lift = S\n");
  CHECK(other.code == 2);
  CHECK(contains(other.err, "the tree has no leaf 'T/Lift'"));
  CHECK(it.study({tree, "--runs", "3"}, "without").code == 3);
}

}  // namespace lockstep::host::test

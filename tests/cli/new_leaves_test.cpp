#include <catch2/catch.hpp>
#include <filesystem>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

const std::string kTree = R"(<root lockstep="1">
  <BehaviorTree ID="Main">
    <Sequence memory="true" name="all">
      <Condition ID="Ready--Now"/>
      <LookFor name="look" place="{place}"/>
      <Check code="place == 'kitchen'"/>
      <Retry attempts="2"><Grasp name="grasp"/></Retry>
      <Grasp name="again"/>
    </Sequence>
  </BehaviorTree>
</root>
)";

}  // namespace

TEST_CASE("new leaves: verify and run take the model as it is") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", kTree);
  const std::string model = directory.path("tree.leaves.xml");
  const Outcome made = run_lockstep({"new", "leaves", tree});
  CHECK(made.code == 0);
  CHECK(made.out == model + "\n");
  CHECK(contains(made.err, "verify " + tree + " --mock --leaves " + model));
  const std::string text = read_file(model);
  CHECK(contains(text, "<leaf of=\"Ready--Now\" result=\"success;failure\"/>"));
  CHECK(contains(text, "Grasp (Main/all/Retry/grasp, Main/all/again) succeeds or fails"));
  CHECK(contains(text, "out.place=\"kitchen|other\" writes=\"any\""));
  const std::string findings = directory.path("out");
  const Outcome verified =
      run_lockstep({"verify", tree, "--mock", "--leaves", model, "--out", findings});
  CHECK(verified.code == 0);
  CHECK(contains(verified.out, "verified"));
  const int code =
      run_lockstep({"run", tree, "--mock", "--leaves", model, "--clock", "virtual"}).code;
  CHECK((code == 0 || code == 1));
  CHECK(run_lockstep({"check", tree, "--mock"}).code == 0);
  CHECK(run_lockstep({"fmt", "--check", model}).code == 0);
}

TEST_CASE("new leaves writes over no file") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", kTree);
  const std::string model = directory.file("tree.leaves.xml", "mine");
  CHECK(run_lockstep({"new", "leaves", tree}).code == 2);
  CHECK(read_file(model) == "mine");
  const std::string other = directory.path("other.leaves.xml");
  CHECK(run_lockstep({"new", "leaves", tree, "--out", other, "--dry-run"}).code == 0);
  CHECK(!std::filesystem::exists(other));
  CHECK(run_lockstep({"new", "leaves", directory.file("bad.xml", "<root")}).code == 3);
}

TEST_CASE("new leaves: a verdict with the untouched model is the verdict without one") {
  const TemporaryDirectory directory;
  for (const std::string name : {"museum_guide", "grip_again", "commands", "cart"}) {
    const std::string tree = LOCKSTEP_SOURCE_DIR "/trees/" + name + ".xml";
    const std::string model = directory.path(name + ".leaves.xml");
    CAPTURE(name);
    CHECK(run_lockstep({"new", "leaves", tree, "--out", model}).code == 0);
    const auto results = [&](std::vector<std::string> more) {
      more.insert(more.begin(), {"verify", tree, "--out", directory.path("out")});
      const Outcome outcome = run_lockstep(more);
      const auto line = outcome.out.find("  results");
      return std::pair(outcome.code, outcome.out.substr(line, outcome.out.find('\n', line) - line));
    };
    CHECK(results({}) == results({"--leaves", model}));
  }
}

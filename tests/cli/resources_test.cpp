// Resources from outside: every room knows who owns what, and who waits for whom.
#include <catch2/catch.hpp>

#include "support/json.h"
#include "support/program.h"

using namespace lockstep::host::test;
using nlohmann::json;

namespace {

// Three that need two of three forks each, so one can move at a time.
constexpr const char* kResourcesTree = R"(<root lockstep="1" main_tree_to_execute="Main">
  <plugin name="motion"/>
  <resources name="forks"/>
  <BehaviorTree ID="Main">
    <Parallel>
      <SubTree ID="Eat" name="P" needs="a;b"/>
      <SubTree ID="Eat" name="K" needs="b;c"/>
      <SubTree ID="Eat" name="C" needs="a;c"/>
    </Parallel>
  </BehaviorTree>
  <BehaviorTree ID="Eat">
    <UseResources pool="forks" resources="{needs}"><Advance name="eat" step="0.1"/></UseResources>
  </BehaviorTree>
</root>)";

class Dinner {
 public:
  Dinner() : tree_(directory_.file("dinner.xml", kResourcesTree)) {}
  std::string recording() const { return directory_.path("dinner.jsonl"); }
  std::string path(const std::string& name) const { return directory_.path(name); }
  Outcome run(std::vector<std::string> more) const {
    std::vector<std::string> all{"run", tree_, "--clock", "virtual"};
    all.insert(all.end(), more.begin(), more.end());
    return run_lockstep(all);
  }
  const std::string& tree() const { return tree_; }

 private:
  TemporaryDirectory directory_;
  std::string tree_;
};

std::string part_of(const json& pool, const std::string& what) {
  std::string text;
  for (const json& child : pool["children"]) {
    text += child["name"].get<std::string>() + " " + child[what].dump() + " ";
  }
  return text;
}

}  // namespace

TEST_CASE("resources: the summary says who waited how long, as text and as JSON") {
  const Dinner dinner;
  const Outcome text = dinner.run({"--view", "none"});
  CHECK(text.code == 0);
  CHECK_THAT(text.out + text.err, Catch::Contains("  Main/forks (resources, 30 ticks)\n"
                                                  "    P/…/eat  waited 9 times"));
  const Outcome outcome = dinner.run({"--view", "none", "--json"});
  CHECK(outcome.code == 0);
  const json summary = parse_json(outcome.out);
  REQUIRE(summary["pools"].size() == 1);
  CHECK(summary["synchronized_nodes"].empty());
  const json& pool = summary["pools"][0];
  CHECK(pool["path"] == "Main/forks");
  CHECK(part_of(pool, "held_ticks") == "P/…/eat 18 K/…/eat 19 C/…/eat 20 ");
}

TEST_CASE(
    "resources: in a pool of more than 26, a member takes over nothing from the one before it") {
  const auto run = [](int resources) {
    std::string names;
    for (int i = 0; i < resources; ++i) names += (i > 0 ? ";r" : "r") + std::to_string(i);
    const auto member = [](const std::string& name, const std::string& keep) {
      return "<UseResources pool=\"p\" resources=\"r0\"" + keep + "><Wait name=\"" + name +
             "\" seconds=\"0.1\"/></UseResources>";
    };
    const TemporaryDirectory directory;
    const std::string keeps = " keep=\"true\"";
    const std::string tree = directory.file(
        "t.xml", "<root lockstep=\"1\"><resources name=\"p\" resources=\"" + names +
                     "\"/><BehaviorTree ID=\"M\"><Parallel><Sequence memory=\"true\">" +
                     member("first", keeps) + member("second", keeps) + "</Sequence>" +
                     member("third", "") + "</Parallel></BehaviorTree></root>");
    return run_lockstep({"run", tree, "--clock", "virtual", "--view", "none"});
  };
  const Outcome small = run(26), large = run(27);
  CHECK(small.code == 0);
  CHECK(contains(small.out, "second  did not wait\n"));
  CHECK_FALSE(contains(small.err, "pool-size"));
  CHECK(large.code == 0);
  CHECK(contains(large.out, "second  waited 1 time, 0.020 s in 2 ticks\n"));
  CHECK(contains(large.err, "warning: the pool 'p' has 27 resources, more than a member can take"));
}

TEST_CASE("resources: the plain log says who waits for whom, and when it goes on") {
  const Dinner dinner;
  const Outcome outcome = dinner.run({"--view", "plain"});
  CHECK(outcome.code == 0);
  CHECK_THAT(outcome.err, Catch::Contains("Main/Parallel/K/UseResources/eat: waits for b "
                                          "(P/…/eat)"));
}

TEST_CASE("resources: a recording says who owns what in each tick, and log knows it") {
  const Dinner dinner;
  REQUIRE(dinner.run({"--view", "none", "--record", dinner.recording()}).code == 0);
  const std::string text = read_file(dinner.recording());
  CHECK_THAT(text, Catch::Contains(R"("resources":["a","b","c"],"members":[3,6,9])"));
  // a;b, b;c and a;c are the sets 3, 6 and 5; who waits has them negative.
  CHECK_THAT(text, Catch::Contains(R"("limits":[[2,3],[5,-6],[8,-5]])"));
  CHECK_THAT(text, Catch::Contains(R"("limits":[[2,-3],[5,6]])"));
  const Outcome info = run_lockstep({"log", "info", dinner.recording()});
  CHECK(info.code == 0);
  CHECK_THAT(info.out, Catch::Contains("    K/…/eat  waited 10 times"));
  const Outcome measure = run_lockstep(
      {"log", "measure", dinner.recording(), "--measure", "held:Main/Parallel/P/UseResources/eat"});
  CHECK(measure.code == 0);
  CHECK_THAT(measure.out, Catch::Contains("18"));
  const Outcome plot =
      run_lockstep({"log", "plot", dinner.recording(), "--out", dinner.path("dinner.svg")});
  CHECK(plot.code == 0);
  CHECK_THAT(read_file(dinner.path("dinner.dat")), Catch::Contains("# K/…/eat is held"));
  CHECK_THAT(read_file(dinner.path("dinner.gp")), Catch::Contains("Main/forks   (3 resources)"));
  CHECK(run_lockstep({"log", "diff", dinner.recording(), dinner.recording()}).code == 0);
}

TEST_CASE("resources: a wrong set in a recording is refused") {
  const Dinner dinner;
  REQUIRE(dinner.run({"--view", "none", "--record", dinner.recording()}).code == 0);
  std::string text = read_file(dinner.recording());
  const std::string limit = "[5,-6]";
  for (const std::string wrong : {"[5,-0.5]", "[5,1125899906842624]", "[5,null]", "[4,-6]"}) {
    INFO(wrong);
    std::string changed = text;
    changed.replace(changed.find(limit), limit.size(), wrong);
    const TemporaryDirectory directory;
    const Outcome outcome = run_lockstep({"log", "info", directory.file("wrong.jsonl", changed)});
    CHECK(outcome.code == 3);
    CHECK_THAT(outcome.err, Catch::Contains(wrong[1] == '5' ? "the limit of a UseResources is not"
                                                            : "a node's limit is not"));
  }
}

TEST_CASE("resources: a study measures how long a node waits") {
  const Dinner dinner;
  const Outcome outcome =
      run_lockstep({"study", dinner.tree(), "--runs", "1", "--measure",
                    "held:Main/Parallel/C/UseResources/eat", "--out", dinner.path("study")});
  CHECK(outcome.code == 0);
  CHECK_THAT(read_file(dinner.path("study") + "/runs.csv"), Catch::Contains(",20"));
}

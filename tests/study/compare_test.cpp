// `lockstep study compare`, from outside.
#include <catch2/catch.hpp>
#include <filesystem>

#include "study/study_case.h"
#include "support/json.h"

namespace lockstep::host::test {
namespace {

Strings compared_study(const Strings& more) {
  Strings arguments{kPaper + "example5.xml",
                    "--runs",
                    "40",
                    "--grid",
                    "noise=0.05",
                    "--grid",
                    "barrier_count=0,10,20",
                    "--measure",
                    "progress-distance",
                    "--measure",
                    "success",
                    "--measure",
                    "predictability:a1@0.6"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

Outcome compare(const StudyCase& it, const std::string& out, const Strings& more) {
  Strings arguments{"study", "compare", it.path(out)};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_lockstep(std::move(arguments));
}

nlohmann::json compared(const StudyCase& it, const std::string& out, const std::string& first,
                        const std::string& second) {
  const Outcome outcome = compare(it, out, {"--json", "--cells", first, second});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  return parse_json(outcome.out);
}

}  // namespace

TEST_CASE("seconds and ticks of the same runs have the same p, whatever the rate") {
  for (const char* rate : {"100", "30", "1000", "10"}) {
    for (const bool is_paired : {true, false}) {
      const StudyCase it;
      Strings words{kPaper + "example5.xml",
                    "--runs",
                    "12",
                    "--grid",
                    "barrier_count=5,10",
                    "--grid",
                    "noise=0.05",
                    "--measure",
                    "ticks",
                    "--measure",
                    "duration",
                    "--rate",
                    rate};
      if (is_paired) words.emplace_back("--paired");
      it.make(words, "out");
      const auto json = compared(it, "out", "0", "1");
      INFO(rate << json.dump());
      CHECK(json["measures"][0]["p"] == json["measures"][1]["p"]);
      CHECK(json["measures"][0]["effect"] == json["measures"][1]["effect"]);
    }
  }
}

TEST_CASE("two cells that differ are found to differ, in either order") {
  const StudyCase it;
  it.make(compared_study({}), "out");
  const auto json = compared(it, "out", "0", "1");
  CHECK(json["paired"] == false);
  CHECK(json["test"] == "Mann-Whitney");
  CHECK(json["a"]["number"] == 0);
  CHECK(json["b"]["grid"]["barrier_count"] == "10");
  REQUIRE(json["measures"].size() == 3);  // a gap is not one
  const auto& distance = json["measures"][0];
  const auto medians = column(it.read("out", "summary.csv"), "median");
  CHECK(distance["measure"] == "progress-distance");
  CHECK(distance["median_a"] == medians.at(0));
  CHECK(distance["median_b"] == medians.at(3));
  CHECK(distance["difference"].get<double>() == Approx(medians.at(3) - medians.at(0)).epsilon(0.1));
  CHECK(distance["difference_low"] < distance["difference"]);
  CHECK(distance["difference"] < distance["difference_high"]);
  CHECK(distance["difference_high"] < 0);
  CHECK(distance["effect"] < -0.9);
  CHECK(distance["p"] < 1e-6);
  CHECK(distance["p_holm"] == 3 * distance["p"].get<double>());
  const auto& success = json["measures"][1];
  CHECK(success["effect"] == 0);
  CHECK(success["p"] == 1);
  const auto turned = compared(it, "out", "1", "0")["measures"][0];
  CHECK(turned["effect"] == -distance["effect"].get<double>());
  CHECK(turned["p"] == distance["p"]);
  CHECK(turned["difference"] == -distance["difference"].get<double>());
  CHECK(turned["difference_low"] == -distance["difference_high"].get<double>());
}

TEST_CASE("the cells of a paired study are compared run by run") {
  const StudyCase it;
  it.make(compared_study({"--paired"}), "out");
  const auto json = compared(it, "out", "1", "2");
  CHECK(json["test"] == "Wilcoxon signed-rank");
  const auto& distance = json["measures"][0];
  const auto values = column(it.read("out", "runs.csv"), "progress-distance Example5/parallel");
  REQUIRE(values.size() == 120);
  int larger = 0;
  std::vector<double> differences;
  for (std::size_t run = 0; run < 40; ++run) {
    differences.push_back(values[80 + run] - values[40 + run]);
    larger += differences.back() > 0 ? 1 : -1;
  }
  std::vector<double> means;  // of each two, and of each with itself
  for (std::size_t i = 0; i < 40; ++i) {
    for (std::size_t j = 0; j <= i; ++j) means.push_back((differences[i] + differences[j]) / 2);
  }
  std::sort(means.begin(), means.end());
  CHECK(distance["n_a"] == 40);
  CHECK(distance["effect"].get<double>() == Approx(larger / 40.0));
  CHECK(distance["difference"].get<double>() == Approx((means[409] + means[410]) / 2));
  CHECK(distance["difference_low"] == means[264]);  // the 265th of 820 from either end
  CHECK(distance["difference_high"] == means[555]);
  CHECK(distance["p"] < 1e-4);
}

TEST_CASE("the differences of paired cells vary less") {
  const StudyCase it;
  const auto variance = [&](const Strings& more, const std::string& out) {
    it.make(compared_study(more), out);
    const auto values = column(it.read(out, "runs.csv"), "progress-distance Example5/parallel");
    double sum = 0, squares = 0;
    for (std::size_t run = 0; run < 40; ++run) {
      const double difference = values.at(80 + run) - values.at(40 + run);
      sum += difference;
      squares += difference * difference;
    }
    return squares / 40 - sum * sum / 1600;
  };
  CHECK(variance({"--paired"}, "paired") < 0.5 * variance({}, "independent"));
}

TEST_CASE("a comparison is a table") {
  const StudyCase it;
  it.make(compared_study({"--paired"}), "out");
  const Outcome outcome = compare(it, "out", {"--cells", "0", "2"});
  const auto all = lines(outcome.out);
  REQUIRE(all.size() == 8);
  CHECK(all[0] == "A: cell 0, noise=0.05, barrier_count=0");
  CHECK(all[1] == "B: cell 2, noise=0.05, barrier_count=20");
  CHECK(all[2] == "paired runs, Wilcoxon signed-rank test");
  CHECK(all[4].starts_with("node "));
  CHECK(contains(all[4], "  B - A  "));
  CHECK(contains(all[4], "  95 % of B - A  "));
  CHECK(all[4].ends_with("p (Holm)"));
  CHECK(all[5].starts_with("Example5/parallel "));
}

TEST_CASE("the interval of the difference has 0 exactly if p is not below 0.05") {
  const StudyCase it;
  for (const Strings& more : {Strings{}, Strings{"--paired"}}) {
    Strings arguments{kPaper + "example5.xml",
                      "--runs",
                      "60",
                      "--grid",
                      "noise=0.05",
                      "--grid",
                      "barrier_count=0,1,2,3,4,10,11,12,20,21,22,23"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const std::string out = more.empty() ? "independent" : "paired";
    it.make(arguments, out);
    int different = 0;
    for (int cell = 1; cell < 12; ++cell) {
      const auto distance =
          compared(it, out, std::to_string(cell - 1), std::to_string(cell))["measures"][0];
      INFO(distance);
      const bool has_zero = distance["difference_low"] <= 0 && 0 <= distance["difference_high"];
      CHECK(has_zero == (distance["p"] >= 0.05));
      different += has_zero ? 0 : 1;
    }
    CHECK(different > 0);
    CHECK(different < 11);
  }
}

TEST_CASE("a p that is too small for a double is not printed as 0") {
  const StudyCase it;
  it.make({kPaper + "example5.xml", "--runs", "1500", "--grid", "barrier_count=0,50"}, "out");
  CHECK(compared(it, "out", "0", "1")["measures"][0]["p"] == 0);
  CHECK(contains(compare(it, "out", {"--cells", "0", "1"}).out, "<1e-300   <1e-300"));
}

TEST_CASE("what has no value in a cell is compared with nothing") {
  const StudyCase it;
  const auto tree =
      it.file("tree.xml",
              "<root lockstep=\"1\" main_tree_to_execute=\"Main\"><arg name=\"seconds\"/>"
              "<BehaviorTree ID=\"Main\"><Wait seconds=\"${seconds}\"/></BehaviorTree></root>");
  it.make({tree, "--runs", "7", "--grid", "seconds=0.05,0.5", "--max-ticks", "20", "--measure",
           "predictability:Wait@0.9", "--measure", "ticks"},
          "out");
  const auto json = compared(it, "out", "0", "1");
  const auto& missing = json["measures"][0];
  CHECK(missing["n_b"] == 0);
  for (const char* key :
       {"median_a", "median_b", "difference", "difference_low", "effect", "p", "p_holm"})
    CHECK(missing[key].is_null());
  CHECK(json["measures"][1]["p_holm"] == json["measures"][1]["p"]);  // one test was made
  CHECK(compare(it, "out", {"--cells", "0", "1"}).code == 0);
}

TEST_CASE("a comparison that cannot be made is refused") {
  const StudyCase it;
  it.make(compared_study({}), "out");
  const auto refused = [&](const Strings& more, const std::string& why) {
    const Outcome outcome = compare(it, "out", more);
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(contains(outcome.err, why));
  };
  refused({}, "--cells");
  refused({"--cells", "1"}, "--cells");
  refused({"--cells", "1", "1"}, "expected two different cells");
  refused({"--cells", "0", "3"}, "has no cell 3");
  refused({"--cells", "0", "x"}, "'x' is not a whole number");
  refused({"--cells", "0", "-1"}, "--cells");
  refused({"--cells", "0", "1", "2"}, "unexpected argument '2'");
  std::filesystem::resize_file(it.path("out/runs.csv"), 3000);
  refused({"--cells", "0", "1"}, "of 120 runs");
  std::filesystem::remove(it.path("out/study.json"));
  refused({"--cells", "0", "1"}, "is not a study");
}

}  // namespace lockstep::host::test

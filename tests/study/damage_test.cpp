// What is read of a study is checked: a study.json or a runs.csv that lockstep cannot have written
// is refused by --resume and by merge, and nothing of it is changed.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "study/study_case.h"

namespace lockstep::host::test {
namespace {

namespace fs = std::filesystem;

// Four runs of 100 ticks, with all kinds of columns.
const Strings kMeasured{
    "--runs",      "4",           "--measure", "progress-distance",        "--measure", "duration",
    "--measure",   "step-length", "--measure", "predictability:a1@0.6=10", "--grid",    "rate=100",
    "--max-ticks", "100"};

Strings damaged_study() {
  Strings arguments{kPaper + "example5.xml", "--arg", "noise=0"};
  arguments.insert(arguments.end(), kMeasured.begin(), kMeasured.end());
  return arguments;
}

struct Damage {
  std::string name, from, to;
};

// In the first row: 0,100,0,<seed>,100,success,7.999999999999974,1,0.050000000000000044,50
const std::vector<Damage> kRowDamages{
    {"another cell", "\n0,100,0,", "\n1,100,0,"},
    {"another value of the grid", "\n0,100,0,", "\n0,101,0,"},
    {"another run", "\n0,100,0,", "\n0,100,1,"},
    {"ticks are no number", ",100,success,", ",x,success,"},
    {"ticks are empty", ",100,success,", ",,success,"},
    {"ticks are 0", ",100,success,", ",0,success,"},
    {"ticks are negative", ",100,success,", ",-100,success,"},
    {"ticks written in another way", ",100,success,", ",0100,success,"},
    {"more ticks than --max-ticks", ",100,success,", ",101,success,"},
    {"more ticks than 64 bits hold", ",100,success,", ",18446744073709551716,success,"},
    {"fewer ticks than the duration has", ",100,success,", ",99,success,"},
    {"an unknown result", ",100,success,", ",100,sucess,"},
    {"no result", ",100,success,", ",100,,"},
    {"a result with a blank", ",100,success,", ",100,success ,"},
    {"a limit before --max-ticks", ",100,success,7.999999999999974,1,",
     ",99,limit,7.999999999999974,0.99,"},
    {"a number that is none", ",7.999999999999974,", ",7.9x,"},
    {"not a number", ",7.999999999999974,", ",nan,"},
    {"infinity", ",7.999999999999974,", ",inf,"},
    {"a number written in another way", ",7.999999999999974,", ",7.9999999999999740,"},
    {"a number with an exponent", ",7.999999999999974,", ",7.999999999999996e1,"},
    {"a number with a sign", ",7.999999999999974,", ",+7.999999999999974,"},
    {"a distance below 0", ",7.999999999999974,", ",-7.999999999999974,"},
    {"a duration of other ticks", ",1,0.050000000000000044,", ",2,0.050000000000000044,"},
    {"a step that is longer than 1", ",1,0.050000000000000044,", ",1,1.05,"},
    {"a step below 0", ",1,0.050000000000000044,", ",1,-0.050000000000000044,"},
    {"an instant between two ticks", ",0.050000000000000044,50,0", ",0.050000000000000044,50.5,0"},
    {"an instant before the run", ",0.050000000000000044,50,0", ",0.050000000000000044,-11,0"},
    {"an instant after the run", ",0.050000000000000044,50,0", ",0.050000000000000044,91,0"},
    {"a gap below 0", ",50,0\n", ",50,-0.5\n"},
    {"a gap above 1", ",50,0\n", ",50,1.5\n"},
    {"an instant without a gap", ",50,0\n", ",50,\n"},
    {"a field too many", ",0.050000000000000044,50,0", ",0.050000000000000044,50,0,"},
    {"a field too few", ",0.050000000000000044,50,0\n", ",0.050000000000000044,50\n"},
    {"the other end of line", ",0.050000000000000044,50,0\n", ",0.050000000000000044,50,0\r\n"},
    {"an empty line", ",0.050000000000000044,50,0\n", ",0.050000000000000044,50,0\n\n"},
    {"a header of other columns", "step-length", "step-height"},
};

const std::vector<Damage> kPlanDamages{
    {"a seed below 0", "\"seed\": 0", "\"seed\": -1"},
    {"a seed that is no whole number", "\"seed\": 0", "\"seed\": 0.0"},
    {"a seed of 2^64", "\"seed\": 0", "\"seed\": 18446744073709551616"},
    {"runs of 2^64", "\"runs\": 4", "\"runs\": 18446744073709551620"},
    {"more runs than can be counted", "\"runs\": 4", "\"runs\": 18446744073709551615"},
    {"no runs", "\"runs\": 4", "\"runs\": 0"},
    {"no ticks", "\"max_ticks\": 100", "\"max_ticks\": 0"},
    {"a rate of 0", "\"rate\": 100.0", "\"rate\": 0.0"},
    {"a rate below 0", "\"rate\": 100.0", "\"rate\": -100.0"},
    {"a rate as text", "\"rate\": 100.0", "\"rate\": \"100\""},
    {"a rate written in another way", "\"rate\": 100.0", "\"rate\": 1e2"},
    {"a grid of another kind", "\"is\": \"rate\"", "\"is\": \"speed\""},
    {"a grid over a rate of 0", "\"100\"", "\"0\""},
    {"a grid with a value twice", "\"100\"", "\"100\", \"100\""},
    {"a grid without values", "\"100\"", ""},
    {"a grid name that is none", "\"name\": \"rate\"", "\"name\": \"r,ate\""},
    {"an unknown measure", "\"step-length\",", "\"step-height\","},
    {"a column that is not measured", "\"measure\": \"duration\"", "\"measure\": \"spread\""},
    {"a key that is not known", "\"runs\": 4", "\"runs\": 4, \"walks\": 4"},
    {"a key that is given twice", "\"runs\": 4", "\"runs\": 3, \"runs\": 4"},
    {"a key that is missing", "\"runs\": 4,", ""},
    {"another format", "\"lockstep_study\": ", "\"lockstep_study\": 9"},
    {"a column that is not its gap", "\"is\": \"gap\"", "\"is\": \"gaps\""},
    {"a column of a cell that is not there", "\"node\": \"Example5\"",
     "\"node\": \"Example5\",\n      \"cells\": [\n        1\n      ]"},
    {"not JSON", "{", "["},
    {"more than JSON", "\n}\n", "\n}\nx\n"},
    {"paired that is off", "\n}\n", ",\n  \"paired\": false\n}\n"},
    {"a precision of nothing", "\n}\n", ",\n  \"until_ci\": \"0%\"\n}\n"},
    {"a precision written in another way", "\n}\n", ",\n  \"until_ci\": \"5.0%\"\n}\n"},
    {"a part until a precision", "\n}\n",
     ",\n  \"until_ci\": \"5%\",\n  \"shard\": {\n    \"part\": 1,\n    \"of\": 2\n  }\n}\n"},
    {"a part of no parts", "\n}\n", ",\n  \"shard\": {\n    \"part\": 1,\n    \"of\": 0\n  }\n}\n"},
    {"a part of more parts than runs", "\n}\n",
     ",\n  \"shard\": {\n    \"part\": 1,\n    \"of\": 9\n  }\n}\n"},
};

void replace_first(const std::string& file, const Damage& damage) {
  std::string text = read_file(file);
  const auto at = text.find(damage.from);
  REQUIRE(at != std::string::npos);
  text.replace(at, damage.from.size(), damage.to);
  std::ofstream(file, std::ios::binary) << text;
}

void check_refused(const StudyCase& it, const Damage& damage, const std::string& name) {
  INFO(damage.name);
  fs::remove_all(it.path("bad"));
  fs::copy(it.path("whole"), it.path("bad"));
  replace_first(it.path("bad/" + name), damage);
  const std::string before = it.bytes("bad");
  auto arguments = damaged_study();
  arguments.emplace_back("--resume");
  for (const Outcome& outcome : {it.study(arguments, "bad"), it.merge({"bad"}, "merged")}) {
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, it.path("bad") + '/' + name));
    CHECK(it.bytes("bad") == before);
    CHECK_FALSE(fs::exists(it.path("merged")));
  }
}

}  // namespace

TEST_CASE("a row that no run of the study can have given is refused") {
  const StudyCase it;
  it.make(damaged_study(), "whole");
  const auto rows = lines(it.read("whole", "runs.csv"));
  REQUIRE(rows.at(1).ends_with(",100,success,7.999999999999974,1,0.050000000000000044,50,0"));
  for (const Damage& damage : kRowDamages) check_refused(it, damage, "runs.csv");
}

TEST_CASE("a study.json that lockstep cannot have written is refused") {
  const StudyCase it;
  it.make(damaged_study(), "whole");
  for (const Damage& damage : kPlanDamages) check_refused(it, damage, "study.json");
}

TEST_CASE("a study file that is a pipe or a directory is refused, and not waited for") {
  const StudyCase it;
  it.make(damaged_study(), "whole");
  auto arguments = damaged_study();
  arguments.emplace_back("--resume");
  for (const std::string name : {"runs.csv", "study.json"}) {
    for (const bool is_pipe : {true, false}) {
      INFO(name << (is_pipe ? " is a pipe" : " is a directory"));
      fs::remove_all(it.path("bad"));
      fs::copy(it.path("whole"), it.path("bad"));
      fs::remove(it.path("bad/" + name));
      const std::string path = it.path("bad/" + name);
      REQUIRE((is_pipe ? mkfifo(path.c_str(), 0600) : mkdir(path.c_str(), 0700)) == 0);
      for (const Outcome& outcome : {it.study(arguments, "bad"), it.merge({"bad"}, "merged")}) {
        INFO(outcome.err);
        CHECK(outcome.code == 2);
        CHECK(contains(outcome.err, "bad"));
        CHECK_FALSE(fs::exists(it.path("merged")));
      }
    }
  }
}

TEST_CASE("a line without an end is read no further than a row can be long") {
  const StudyCase it;
  it.make(damaged_study(), "whole");
  const std::string rows = it.read("whole", "runs.csv");
  std::ofstream(it.path("whole/runs.csv"), std::ios::binary)
      << rows << std::string(std::size_t{64} << 20u, '1') << '\n';
  auto arguments = damaged_study();
  arguments.emplace_back("--resume");
  const Outcome outcome = it.study(arguments, "whole");
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "line 6: not a row"));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // whose own memory counts too
  CHECK(outcome.peak_megabytes < 60);
#endif
}

TEST_CASE("a study writes through no symbolic link") {
  const StudyCase it;
  const auto victim = it.file("victim", "precious");
  fs::create_directory(it.path("out"));
  SECTION("study.json.new") {
    fs::create_symlink(victim, it.path("out/study.json.new"));
    it.make(damaged_study(), "out");
  }
  SECTION("summary.csv.new") {
    it.make(damaged_study(), "out");
    fs::create_symlink(victim, it.path("out/summary.csv.new"));
    auto arguments = damaged_study();
    arguments.emplace_back("--resume");
    it.make(arguments, "out");
  }
  SECTION("runs.csv") {
    fs::create_symlink(it.path("nowhere"), it.path("out/runs.csv"));
    CHECK(it.study(damaged_study(), "out").code == 2);
    CHECK_FALSE(fs::exists(it.path("nowhere")));
    CHECK_FALSE(fs::exists(it.path("out/study.json")));
  }
  CHECK(read_file(victim) == "precious");
}

}  // namespace lockstep::host::test

// What is measured of a recording is what a study measures of the run.
#include "record/use/recording_measures.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "judge/measure/measure_spec.h"
#include "record/use/recording_info.h"
#include "record/write/recorder.h"
#include "run/shape_of.h"
#include "study/run_measures.h"
#include "unit/recording/watched_run.h"

namespace lockstep::host {
namespace {

using test::recorded_lines;
using test::TemporaryPath;
using test::WatchedRun;

std::vector<MeasureSpec> measures_of(std::initializer_list<const char*> texts) {
  std::vector<MeasureSpec> measures;
  for (const char* text : texts) {
    measures.push_back(parse_measure(text).value());
  }
  return measures;
}

struct Case {
  const char *law, *tree, *leaves;
};

constexpr Case kCases[] = {
    {"a node that succeeds", "ParallelAbsolute[barriers=.5;1](a b)", "a+.1 b+.3"},
    {"a node that fails", "ParallelAbsolute[barriers=.5](a b)", "a=R.1RRF b+.6"},
    {"a node that is begun again", "Repeat[times=2](ParallelRelative[delta=1](a b))", "a+.1 b+.2"},
    {"a node that an ancestor ends", "Parallel(ParallelRelative[delta=1](a b) c)",
     "a+.1 b+.2 c=RRRF"},
    {"a node that succeeds and that an ancestor ends in the same tick",
     "Parallel(Sequence[memory=true](ParallelRelative[delta=1](a b) w) c)",
     "a+.5 b+.3,.7 w=R c=RF"},
    {"a child that succeeds in the tick in which an ancestor ends its node",
     "Parallel(ParallelRelative[delta=1](a b) Parallel(d e) c)", "a+.1,.9 b+.1 c=RF d+.2,.8 e=R"},
    {"a node that a script decides, and that one halts",
     "Sequence[memory=true](Script[code=k:=0] Parallel[success_count=2](ParallelRelative[delta=1 "
     "while=k<1](a b) Script[code=k:=k+1] w))",
     "a+.2 b+.1 w=RRRRS"},
    {"a node that is held, and a plain parallel beside it",
     "Sequence[memory=true](ParallelAbsolute[barriers=.5;1](a b) Parallel(c d))",
     "a+.1 b+.3 c+.5 d+.2"},
    {"a child that is skipped, at first and later, and begins again",
     "Repeat[times=2](ParallelAbsolute[barriers=.3;1](a b c))", "a+.2 b+.5 c=KKR.3KR.8SKKS"},
    {"the same in a plain parallel",
     "Sequence[memory=true](ParallelAbsolute[barriers=.5](a b) Repeat[times=2](Parallel(d c)))",
     "a+.2 b+.5 c=KKR.3KR.8SKKS d+.2"},
};

// The same numbers as without the guard, which the first case of each pair has.
constexpr Case kGuarded[] = {
    {"a guard in a synchronized node", "ParallelRelative[delta=.05](a g? b)", "a+.01 b+.02 g=S"},
    {"without it", "ParallelRelative[delta=.05](a b)", "a+.01 b+.02"},
    {"a guard that is an Inverter, in a plain parallel", "Parallel(a b Inverter(g?))",
     "a+.01 b+.02 g=F"},
    {"without it", "Parallel(a b)", "a+.01 b+.02"},
    {"a guard in a member of a barrier",
     "Parallel(SyncProgress[barrier=m](g?) SyncProgress[barrier=m](a) SyncProgress[barrier=m](b))"
     " barrier[name=m barriers=.5]",
     "a+.01 b+.02 g=S"},
    {"without it",
     "Parallel(SyncProgress[barrier=m](a) SyncProgress[barrier=m](b)) barrier[name=m barriers=.5]",
     "a+.01 b+.02"},
    {"a child that succeeds while an ancestor ends its node",
     "Sequence(ParallelRelative[delta=1](a b g?))", "a+.1 b+.2 g=S"},
    {"without it", "Sequence(ParallelRelative[delta=1](a b))", "a+.1 b+.2"},
};

constexpr Case kPools[] = {
    {"members that take turns",
     "Parallel(UseResources[pool=p resources=A](a) UseResources[pool=p resources=A](b))"
     " resources[name=p]",
     "a+.2 b+.3"},
    {"one that is not reached in each tick, and one that is halted",
     "Parallel[success_count=1](UseResources[pool=p resources=A;B](a)"
     " Fallback(Sequence(g? UseResources[pool=p resources=A](b)) c)) resources[name=p increment=0]",
     "a+.2 b+.3 g=FSSSFS c=R"},
    {"one that nobody reaches",
     "Fallback(UseResources[pool=p resources=A](a)"
     " UseResources[pool=p resources=A](b)) resources[name=p]",
     "a+.2 b+.3"},
};

// In all cases; -1: not reached.
using ValuesOfMeasures = std::map<std::string, std::vector<double>>;

void compare(const Case& it, std::span<const MeasureSpec> measures, ValuesOfMeasures& of_measure) {
  INFO(it.law);
  const TemporaryPath file;
  WatchedRun run(it.tree, it.leaves);
  Recorder recorder(shape_of(run.run.tree()),
                    {.path = file.path(), .run = {.tree_file = "a.xml", .rate_hz = 10}});
  RunMeasures of_run(shape_of(run.run.tree()), measures, 10);
  REQUIRE(of_run.error() == "");
  run.watch({&recorder, &of_run});

  std::istringstream text(file.text());
  RecordingReader reader(text, "run.jsonl");
  const auto of_recording = measure_recording(reader, measures).value();
  CHECK(reader.error() == "");
  std::size_t at = 0;
  for (std::size_t i = 0; i < of_run.columns().size(); ++i) {
    const StudyColumn& column = of_run.columns()[i];
    INFO(column.measure << ' ' << column.node);
    if (column.is_gap) {
      CHECK(of_recording.at(at - 1).gap == of_run.values()[i]);
      continue;
    }
    const MeasuredValue& measured = of_recording.at(at++);
    CHECK(to_text(*measured.measure) == column.measure);
    CHECK(measured.node == column.node);
    const double expected = of_run.values()[i];
    CHECK((measured.value == expected || (std::isnan(measured.value) && std::isnan(expected))));
    of_measure[column.measure].push_back(std::isnan(expected) ? -1 : expected);
  }
  CHECK(at == of_recording.size());
}

// `text` without the lines of these ticks, as a slow disk leaves it.
std::string without_ticks(const std::string& text, std::uint64_t first, std::uint64_t end) {
  const auto line = [&](std::uint64_t tick) {
    return text.find(fmt::format("{{\"tick\":{},", tick));
  };
  return text.substr(0, line(first)) +
         fmt::format("{{\"lost\":{{\"ticks\":{},\"from\":{}}}}}\n", end - first, first) +
         text.substr(line(end));
}

double measured(const std::string& text, const char* measure) {
  std::istringstream in(text);
  RecordingReader reader(in, "run.jsonl");
  const auto measures = measures_of({measure});
  const double value = measure_recording(reader, measures).value().at(0).value;
  CHECK(reader.error() == "");
  return value;
}

// In the text of `log info`.
std::string longest_step(const std::string& text) {
  std::istringstream in(text);
  RecordingReader reader(in, "run.jsonl");
  const std::string info = info_text(reader);
  CHECK(reader.error() == "");
  constexpr std::string_view kBefore = "longest step ";
  const auto at = info.find(kBefore);
  REQUIRE(at != info.npos);
  return info.substr(at + kBefore.size(), info.find_first_of(",\n", at) - at - kBefore.size());
}

constexpr const char* kSteps = "ParallelRelative[delta=1](a b)";

}  // namespace

TEST_CASE("a recording has the measures of its run") {
  const auto measures =
      measures_of({"progress-distance", "progress-distance[1:3]", "progress-distance-mean",
                   "progress-distance-seconds", "spread", "step-length", "held:b", "held-by:b:a",
                   "pauses:b", "duration", "ticks", "success", "predictability:b@0.4=1"});
  const auto of_pools = measures_of({"waits:a", "waits:b", "held:b", "fairness:p"});
  ValuesOfMeasures of_measure;
  for (const Case& it : kCases) compare(it, measures, of_measure);
  for (const Case& it : kPools) compare(it, of_pools, of_measure);
  // None of them can pass for another.
  std::set<std::vector<double>> different;
  for (const auto& [measure, numbers] : of_measure) {
    INFO(measure);
    CHECK(different.insert(numbers).second);
  }
}

TEST_CASE("a recording names its guards, which are part of no measure") {
  const auto measures = measures_of({"progress-distance", "progress-distance-mean", "spread",
                                     "step-length", "held:b", "pauses:a"});
  for (std::size_t i = 0; i + 1 < std::size(kGuarded); i += 2) {
    const bool is_plain = std::string_view(kGuarded[i].tree).find("Parallel(a") == 0;
    const auto asked = std::span(measures).first(is_plain ? 4 : measures.size());
    ValuesOfMeasures with, without;
    compare(kGuarded[i], asked, with);
    compare(kGuarded[i + 1], asked, without);
    INFO(kGuarded[i].law);
    CHECK(with == without);
    CHECK(with.at("spread").at(0) > 0);
  }
}

TEST_CASE("a tick that a script decides adds nothing to the measures of a synchronized node") {
  const auto measures = measures_of({"progress-distance", "spread", "step-length"});
  std::vector<double> expected;
  for (const char* times : {"1", "3"}) {
    const TemporaryPath file;
    WatchedRun run("Sequence[memory=true](Script[code=n:=0] Repeat[times=" + std::string(times) +
                       "](ParallelAbsolute[barriers=.5;1 success_if=n>0 on_success=n:=1](a b)))",
                   "a+.1 b+.3");
    Recorder recorder(shape_of(run.run.tree()),
                      {.path = file.path(), .run = {.tree_file = "a.xml", .rate_hz = 10}});
    RunMeasures of_run(shape_of(run.run.tree()), measures, 10);
    run.watch({&recorder, &of_run});
    std::istringstream text(file.text());
    RecordingReader reader(text, "run.jsonl");
    const auto of_recording = measure_recording(reader, measures).value();
    if (expected.empty()) expected = {of_run.values().begin(), of_run.values().end()};
    CHECK(expected[0] > 0);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      CHECK(of_run.values()[i] == expected[i]);
      CHECK(of_recording[i].value == expected[i]);
    }
  }
}

TEST_CASE("a plain Parallel is measured by the progress before each of its ticks") {
  const TemporaryPath file;
  // It runs twice: none of its children has progress when it begins again.
  WatchedRun run("Repeat[times=2](Parallel(a b))", "a+.5 b+.25");
  Recorder recorder(shape_of(run.run.tree()),
                    {.path = file.path(), .run = {.tree_file = "a.xml", .rate_hz = 10}});
  const auto measures = measures_of({"progress-distance", "spread", "step-length"});
  RunMeasures of_run(shape_of(run.run.tree()), measures, 10);
  run.watch({&recorder, &of_run});
  // Before its ticks (0, 0) (.5, .25) (1, .5) (1, .75), and the same again.
  CHECK(of_run.values()[0] == Approx(2 * (.25 + .5 + .25)));
  CHECK(of_run.values()[1] == Approx(.5));
  CHECK(of_run.values()[2] == Approx(.5));
  std::istringstream text(file.text());
  RecordingReader reader(text, "run.jsonl");
  const auto of_recording = measure_recording(reader, measures).value();
  REQUIRE(of_recording.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(of_recording[i].value == of_run.values()[i]);
}

TEST_CASE("a recording has the number of an entry after the last tick") {
  const TemporaryPath file;
  WatchedRun run("Parallel(Wait[seconds={pause}] ParallelAbsolute[barriers={plan}](a))", "a=RS");
  Recorder recorder(shape_of(run.run.tree()),
                    {.path = file.path(), .run = {.tree_file = "a.xml", .rate_hz = 10}});
  const auto measures = measures_of({"entry:pause"});
  RunMeasures of_run(shape_of(run.run.tree()), measures, 10);
  run.run.set("pause", 0.25);
  run.run.set("plan", std::vector<double>{0.5});
  run.watch({&recorder, &of_run});
  CHECK(of_run.values()[0] == 0.25);
  std::istringstream text(file.text());
  RecordingReader reader(text, "run.jsonl");
  const auto of_recording = measure_recording(reader, measures).value();
  REQUIRE(of_recording.size() == 1);
  CHECK(of_recording[0].value == 0.25);
  std::istringstream again(file.text());
  RecordingReader other(again, "run.jsonl");
  CHECK(measure_recording(other, measures_of({"entry:plan"})).error().message ==
        "the entry 'plan' is a list of double, expected a number");
}

TEST_CASE("a recording that is cut does not say whether the run succeeded") {
  const TemporaryPath file;
  WatchedRun run("ParallelRelative[delta=1](a b)", "a+.5 b+.5");
  Recorder recorder(shape_of(run.run.tree()),
                    {.path = file.path(), .run = {.tree_file = "a.xml", .rate_hz = 10}});
  run.watch({&recorder});
  const std::string whole = file.text();
  std::istringstream text(whole.substr(0, whole.find("{\"end\"")));
  RecordingReader reader(text, "run.jsonl");
  const auto measures = measures_of({"success", "ticks"});
  const auto values = measure_recording(reader, measures).value();
  REQUIRE(values.size() == 2);
  CHECK(std::isnan(values[0].value));
  CHECK(values[1].value == 2);
}

TEST_CASE("a change over ticks that are missing is not one step of a child") {
  const std::string text = recorded_lines(kSteps, "a+.01 b+.1", 0, 9);
  CHECK(measured(text, "step-length") == Approx(.1));
  const std::string with_gap = without_ticks(text, 3, 6);
  CHECK(measured(with_gap, "step-length") == Approx(.1));
  CHECK(longest_step(with_gap) == "0.1");
}

TEST_CASE("a change over a cut of the run is not one step of a child") {
  const std::string text = recorded_lines(kSteps, "a+.01 b+.1", 0, 6) +
                           "{\"continued\":{\"ticks\":6}}\n" +
                           recorded_lines(kSteps, "a+.01 b+.1", 6, 9);
  CHECK(measured(text, "ticks") == 9);
  CHECK(measured(text, "step-length") == Approx(.1));
  CHECK(longest_step(text) == "0.1");
}

TEST_CASE("ticks in which a node waited are not in a row if ticks between them are missing") {
  constexpr const char* kPool =
      "Parallel(UseResources[pool=p resources=A](a) UseResources[pool=p resources=A](b))"
      " resources[name=p increment=0]";
  const std::string text = recorded_lines(kPool, "a+.01 b+.01", 0, 10);
  CHECK(measured(text, "waits:b") == 10);
  CHECK(measured(without_ticks(text, 3, 5), "waits:b") == 5);
}

TEST_CASE("a recording tells of a node that has succeeded and was ended in the same tick") {
  const TemporaryPath file;
  WatchedRun run("Parallel(Sequence[memory=true](ParallelRelative[delta=1](a b) w) c)",
                 "a+.5 b+.3,.7 w=R c=RF");
  Recorder recorder(shape_of(run.run.tree()),
                    {.path = file.path(), .run = {.tree_file = "a.xml", .rate_hz = 10}});
  run.watch({&recorder});

  CHECK(file.text().find("],\"succeeded\":[2,3,4]") != std::string::npos);
}

}  // namespace lockstep::host

// The rows of measures: what they say of themselves, and what they measure of a live run.
#include "measure/measuring.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "measure/live_ticks.h"
#include "measure/measure_spec.h"
#include "support/paths.h"
#include "support/scripted_run.h"

namespace lockstep {
namespace {

// One measure of a run at 10 Hz, until the root completes; of the first node that it is of.
double measured(const char* text, std::string_view tree, std::string_view leaves) {
  const auto spec = parse_measure(text);
  REQUIRE(spec);
  test::ScriptedRun run(tree, leaves);
  Measuring measuring(measured_tree(run.tree()), {&*spec, 1});
  INFO(measuring.error());
  REQUIRE_FALSE(measuring.columns().empty());
  LiveTicks ticks(run.tree(), measuring);
  EndView end{.rate = 10, .real_time = false};
  for (Status status = Status::Running; status == Status::Running; ++end.ticks) {
    REQUIRE(end.ticks < 100);
    const Nanoseconds now = std::chrono::milliseconds(100) * end.ticks;
    ticks.before_tick(run.ticker());
    status = run.tick(now);
    measuring.after_tick(ticks.read(run.ticker(), end.ticks, now));
    end.succeeded = status == Status::Success;
  }
  return measuring.value(0, end);
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

// Worked by hand from who is ticked: A1 and R2 of the paper's algorithms.
TEST_CASE("measures of worked traces") {
  struct Row {
    const char* measure;
    double a1, r2;
  };
  for (const Row& row :
       {Row{"progress-distance", 2.1, .6}, Row{"progress-distance[0:2]", .6, .2},
        Row{"progress-distance[7:7]", .3, NAN}, Row{"progress-distance-mean", .21, .6 / 7},
        Row{"progress-distance-seconds", .21, .06}, Row{"spread", .4, .2},
        Row{"step-length", .3, .3}, Row{"held:a", 0, 1}, Row{"held:b", 3, 3}, Row{"pauses:a", 0, 1},
        Row{"pauses:b", 1, 3}, Row{"duration", 1, .7}, Row{"ticks", 10, 7}, Row{"success", 1, 1},
        Row{"predictability:b@0.6=3", -1, 0}}) {
    INFO(row.measure);
    CHECK(measured(row.measure, "ParallelAbsolute[barriers=.5;1](a b)", "a+.1 b+.3") ==
          Approx(row.a1).margin(1e-9));
    const double r2 = measured(row.measure, "ParallelRelative[delta=0](a b)", "a+.2 b+.3");
    CHECK((std::isnan(row.r2) ? std::isnan(r2) : r2 == Approx(row.r2).margin(1e-9)));
  }
}

TEST_CASE("the tick in which a synchronized node ends counts as held") {
  CHECK(measured("held:b", "ParallelAbsolute[barriers=.5](a b)", "a=R.1RRF b+.6") == 3);
  CHECK(measured("success", "ParallelAbsolute[barriers=.5](a b)", "a=R.1RRF b+.6") == 0);
}

TEST_CASE("the longest step is of a child's own progress") {
  const auto steps = [](std::string_view tree, std::string_view leaves) {
    return measured("step-length", tree, leaves);
  };
  // A node that ends does not change the progress of its unfinished children …
  CHECK(steps("ParallelRelative[delta=1 success_count=1](a b)", "a+.5 b+.125") == Approx(.5));
  CHECK(steps("Parallel[success_count=1](a b)", "a+.5 b+.125") == Approx(.5));
  CHECK(steps("ParallelAbsolute[barriers=](a b)", "a+.125 b=R.25F") == Approx(.25));
  // … but one that succeeds goes to 1, whatever it had reported, and so does one that is latched.
  CHECK(steps("ParallelRelative[delta=1 success_count=1](a b)", "a=RS b+.125") == Approx(1));
  CHECK(steps("ParallelAbsolute[barriers=](a b)", "a=R.25S b=R.5F") == Approx(.75));
  CHECK(steps("ParallelRelative[delta=1 failure_count=2 success_count=1](a b)",
              "a=R.25F b=R.25R.5R.75S") == Approx(.75));
}

TEST_CASE("in a plain Parallel, too, a child that has failed for good counts as 1") {
  CHECK(measured("spread", "Parallel[failure_count=2 success_count=1](a b)", "a=F b=R.5R.5S") ==
        Approx(1));
  CHECK(measured("spread", "Parallel[failure_count=2 success_count=1](c? b)", "c=F... b=R.5R.5S") ==
        Approx(.5));
}

TEST_CASE("a child whose node no tick has reached was not held 0 times") {
  CHECK(
      std::isnan(measured("held:a", "Fallback(c ParallelRelative[delta=0](a b))", "c=S a=R b=R")));
  CHECK(std::isnan(
      measured("pauses:a", "Fallback(c ParallelRelative[delta=0](a b))", "c=S a=R b=R")));
}

TEST_CASE("the progress distance of a plain Parallel") {
  // Before its ticks (0, 0) (.25, .5) (.5, 1) (.75, 1).
  const char* leaves = "a+.25 b+.5";
  CHECK(measured("progress-distance", "Parallel(a b)", leaves) == Approx(1));
  CHECK(measured("progress-distance", "ParallelRelative[delta=1](a b)", leaves) == Approx(1));
  CHECK(measured("step-length", "Parallel(a b)", leaves) == Approx(.5));
}

TEST_CASE("a measure is written as it is read") {
  for (const char* text : {"progress-distance", "progress-distance[0:99]", "held:pull/arm",
                           "entry:lap:2", "predictability:a@b@0.5", "predictability:a=1@0.5=10"}) {
    const auto spec = parse_measure(text);
    INFO(text);
    REQUIRE(spec);
    CHECK(to_text(*spec) == text);
  }
  CHECK(to_text(*parse_measure("predictability:a@0.50=1e1")) == "predictability:a@0.5=10");
  CHECK(to_text(*parse_measure("progress-distance[00:9]")) == "progress-distance[0:9]");
  for (const char* text : {"progress-distance[", "progress-distance[]", "progress-distance[1]",
                           "progress-distance[-1:2]", "progress-distance[0:1]x", "held:", "held",
                           "spread[0:1]", "ticks:a", "", ":", "[0:1]"}) {
    INFO(text);
    CHECK_FALSE(parse_measure(text));
  }
}

TEST_CASE("axes of plots name the measure and its unit") {
  const auto label = [](const char* text) { return axis_label(parse_measure(text).value()); };
  CHECK(label("duration") == "duration (s)");
  CHECK(label("spread") == "largest spread");
  CHECK(label("held:arm") == "held (ticks)");
  CHECK(label("entry:lap") == "lap");
  CHECK(label("predictability:arm@0.6") == "instant of progress 0.6 (ticks)");
  CHECK(label("predictability:arm@0.6=3") == "predictability distance at 0.6 (ticks)");
}

TEST_CASE("an entry is measured when it is a number") {
  MeasuredTree tree{.id = "Main",
                    .paths = {"Main/a"},
                    .nodes = {{}},
                    .entries = {"lap", "part/lap", "name"},
                    .entry_types = {"int", "double", "string"}};
  const auto measure = [&](const char* text) {
    const MeasureSpec spec = parse_measure(text).value();
    Measuring measuring(tree, {&spec, 1});
    if (!measuring.error().empty()) return measuring.error();
    CHECK(measuring.columns()[0].node == "Main");
    CHECK(std::isnan(measuring.value(0, {})));  // no tick
    for (const double number : {7.0, measuring.entries()[0] == 1 ? INFINITY : 3.0}) {
      measuring.after_tick({.entries = {&number, 1}});
    }
    const double value = measuring.value(0, {});
    return std::isnan(value) ? std::string("none") : std::to_string(value);
  };
  CHECK(measure("entry:lap") == "3.000000");
  CHECK(measure("entry:part/lap") == "none");  // it is no number
  CHECK(measure("entry:name") == "the entry 'name' is a string, expected a number");
  CHECK(measure("entry:lab") == "no entry 'lab', did you mean 'lap'?");
  tree.entries.clear();
  CHECK(measure("entry:lap") == "no entry 'lap'");
}

TEST_CASE("docs/studies.md has the table of the measures") {
  const std::string docs = text_of(LOCKSTEP_SOURCE_DIR "/docs/studies.md");
  std::string table = "| Measure | Of | Meaning |\n|---|---|---|\n";
  for (const Measure* measure : all_measures()) {
    table.append("| `").append(measure->name).append(measure->argument).append("` | ");
    table.append(to_string(measure->of)).append(" | ").append(measure->doc).append(" |\n");
  }
  INFO("the table should be\n" << table);
  CHECK(docs.find("\n" + table + "\n") != std::string::npos);
}

}  // namespace lockstep

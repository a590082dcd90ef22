// The rows of measures: what they say of themselves, and what they measure of a live run.
#include "judge/measure/measuring.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "judge/measure/measure_spec.h"
#include "run/live_moments.h"
#include "support/generated_file.h"
#include "support/scripted_run.h"

namespace lockstep::host {
namespace {

// One measure of a run at 10 Hz, until the root completes or for so many ticks; of the first node
// that it is of.
double measured(const char* text, std::string_view tree, std::string_view leaves,
                std::uint64_t most = 100) {
  const auto spec = parse_measure(text);
  REQUIRE(spec);
  test::ScriptedRun run(tree, leaves);
  Measuring measuring(shape_of(run.tree()), {&*spec, 1});
  INFO(measuring.error());
  REQUIRE_FALSE(measuring.columns().empty());
  LiveMoments moments(run.tree(), measuring.asked());
  EndView end{.rate = 10, .real_time = false};
  for (Status status = Status::Running; status == Status::Running && end.ticks < most;
       ++end.ticks) {
    REQUIRE(end.ticks < 99);
    const Nanoseconds now = std::chrono::milliseconds(100) * end.ticks;
    moments.before_tick(run.ticker());
    status = run.tick(now);
    measuring.after_tick(moments.after_tick(run.ticker(), end.ticks, now));
    end.succeeded = status == Status::Success;
  }
  return measuring.value(0, end);
}

// What is wrong with a measure of a tree.
std::string error_of(const char* text, std::string_view tree, std::string_view leaves) {
  const auto spec = parse_measure(text);
  if (!spec) return spec.error().message;
  const test::ScriptedRun run(tree, leaves);
  return Measuring(shape_of(run.tree()), {&*spec, 1}).error();
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
        Row{"step-length", .3, .3}, Row{"held:a", 0, 1}, Row{"held:b", 3, 3},
        Row{"held-by:a:b", 0, 1}, Row{"held-by:b:a", 3, 3}, Row{"pauses:a", 0, 1},
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
  CHECK(measured("spread", "Parallel[failure_count=2 success_count=1](a b)", "a=F b=R.25R.5S") ==
        Approx(.75));
}

TEST_CASE("a child is held by the first one with the least progress") {
  // Ticked: abc b ab bc ab b abc b ab bc. The rounding of .1 + .1 + .1 makes nobody less.
  const char *tree = "ParallelRelative[delta=0](a b c)", *leaves = "a+.2 b+.1 c+.3";
  CHECK(measured("ticks", tree, leaves) == 10);
  CHECK(measured("held:a", tree, leaves) == 4);
  CHECK(measured("held-by:a:b", tree, leaves) == 4);
  CHECK(measured("held-by:a:c", tree, leaves) == 0);
  CHECK(measured("held:b", tree, leaves) == 0);
  CHECK(measured("held:c", tree, leaves) == 6);
  CHECK(measured("held-by:c:a", tree, leaves) == 3);
  CHECK(measured("held-by:c:b", tree, leaves) == 3);
}

TEST_CASE("a member of a barrier is held by a member of the same barrier") {
  const char* tree =
      "ParallelRelative[delta=1](Sequence(SyncProgress[barrier=g](a)) SyncProgress[barrier=g](b) c)"
      " barrier[name=g barriers=.5;1]";
  const char* leaves = "a+.1 b+.3 c+.1";
  CHECK(measured("held:b", tree, leaves) == 3);
  CHECK(measured("held-by:b:a", tree, leaves) == 3);
  CHECK(measured("held-by:b:Sequence/SyncProgress", tree, leaves) == 3);
  // The barrier's node is in the parallel, too, which holds nobody.
  CHECK(measured("held-by:ParallelRelative/SyncProgress:c", tree, leaves) == 0);
  CHECK(error_of("held-by:b:c", tree, leaves) ==
        "no child next to 'Test/ParallelRelative/SyncProgress/b' named 'c', there are: "
        "'Test/ParallelRelative/Sequence/SyncProgress/a', "
        "'Test/ParallelRelative/Sequence/SyncProgress'");
}

TEST_CASE("who holds whom needs two children of one synchronized node") {
  const char *tree = "Parallel(ParallelRelative[delta=0](arm base) other)",
             *leaves = "arm=R base=R other=R";
  CHECK(error_of("held-by:arn:base", tree, leaves) == "no node 'arn', did you mean 'arm'?");
  CHECK(error_of("held-by:arm:bas", tree, leaves) ==
        "no child next to 'Test/Parallel/ParallelRelative/arm' named 'bas', did you mean 'base'?");
  CHECK(error_of("held-by:arm:arm", tree, leaves) ==
        "no child next to 'Test/Parallel/ParallelRelative/arm' named 'arm', there are: "
        "'Test/Parallel/ParallelRelative/base'");
  CHECK(error_of("held-by:other:arm", tree, leaves) ==
        "'Test/Parallel/other' is not a child of a synchronized node or of a SyncProgress, so no "
        "other "
        "child holds it");
  for (const char* text :
       {"held-by", "held-by:", "held-by:a", "held-by:a:", "held-by::b", "held-by:a:b:c",
        "held-by:\"a:b", "held-by:\"a\"x:b", "held-by:\"\":b"}) {
    INFO(text);
    CHECK(error_of(text, tree, leaves).starts_with("expected 'held-by:A:B', two names"));
  }
}

namespace {

const char* const kGreedy =
    "Parallel(UseResources[pool=p resources=A;B](a) UseResources[pool=p resources=B;C](b)"
    " UseResources[pool=p resources=A;C](c)) resources[name=p increment=0]";
const char* const kFair =
    "Parallel(UseResources[pool=p resources=A;B](a) UseResources[pool=p resources=B;C](b)"
    " UseResources[pool=p resources=A;C](c)) resources[name=p increment=1]";
const char* const kFour =
    "Parallel(UseResources[pool=p resources=A](a) UseResources[pool=p resources=B](b)"
    " UseResources[pool=p resources=A;B](c) UseResources[pool=p resources=C](d))"
    " resources[name=p increment=1]";

}  // namespace

// The traces are in tests/nodes/use_resources_test.cpp.
TEST_CASE("the longest wait for resources in worked traces") {
  const char *ten = "a+.1 b+.1 c+.1", *six = "a=RRRRRS b=RRRRRS c=RRRRRS d=RRRRRS";
  struct Row {
    const char* node;
    double greedy, fair, four;
  };
  for (const Row& row : {Row{"a", 0, 2, 1}, Row{"b", 10, 2, 1}, Row{"c", 20, 2, 1}}) {
    const std::string measure = std::string("waits:") + row.node;
    INFO(measure);
    CHECK(measured(measure.c_str(), kGreedy, ten) == row.greedy);
    CHECK(measured(measure.c_str(), kFair, ten) == row.fair);
    CHECK(measured(measure.c_str(), kFour, six) == row.four);
  }
  CHECK(measured("waits:d", kFour, six) == 0);
}

TEST_CASE("a tick in which a member is not reached ends its wait") {
  // It waits in the ticks 2, 3 and 5, since the guard fails in the fourth.
  const char* tree =
      "Parallel(UseResources[pool=p resources=A](a)"
      " Fallback(Sequence(g? UseResources[pool=p resources=A](b)) r)) resources[name=p "
      "increment=0]";
  const char* leaves = "a=R g=FSSFSF b=R r=R";
  CHECK(measured("waits:b", tree, leaves, 6) == 2);
  CHECK(std::isnan(measured("waits:b", tree, leaves, 1)));  // no tick has reached it
  CHECK(measured("waits:a", tree, leaves, 1) == 0);
}

TEST_CASE("nobody knows whether a member waited in a tick that a recording has lost") {
  const MeasureSpec spec = parse_measure("waits:a").value();
  const auto wait = spec.measure->make(spec, {.nodes = {0}});
  const double refused = -1;
  const double* const limits[] = {&refused};
  const std::uint32_t reached[] = {1};
  for (const std::uint64_t tick : {0, 1, 3, 4, 5, 8}) {
    if (tick == 3 || tick == 8) wait->join(Joint::Lost);
    if (tick == 5) wait->join(Joint::Cut);  // the tick before it is known
    const Moment moment{.tick = tick, .reached = reached, .number = 1, .limits = limits};
    wait->after_tick({.moment = &moment});
  }
  CHECK(wait->value({}) == 3);
  wait->reset();
  CHECK(std::isnan(wait->value({})));
}

TEST_CASE("Jain's fairness index in worked traces") {
  const char *ten = "a+.1 b+.1 c+.1", *six = "a=RRRRRS b=RRRRRS c=RRRRRS d=RRRRRS";
  // In the end each had its ten ticks, whatever the order.
  CHECK(measured("fairness:p", kGreedy, ten) == 1);
  CHECK(measured("fairness:p", kFair, ten) == 1);
  CHECK(measured("fairness:p", kGreedy, ten, 10) == Approx(1. / 3));
  CHECK(measured("fairness:p", kGreedy, ten, 15) == Approx(225. / (3 * 125)));
  CHECK(measured("fairness:p", kFair, ten, 15) == 1);
  CHECK(measured("fairness:p", kFair, ten, 4) == Approx(16. / (3 * 6)));
  CHECK(measured("fairness:p", kFour, six, 4) == Approx(100. / (4 * 28)));
}

TEST_CASE("a pool that nobody owned anything of has no fairness") {
  const char* tree =
      "Sequence[memory=true](w UseResources[pool=p resources=A](a)) resources[name=p]";
  CHECK(std::isnan(measured("fairness:p", tree, "w=RRS a=RS", 2)));
  CHECK(measured("fairness:p", tree, "w=RRS a=RS") == 1);
}

TEST_CASE("measures of resources name a UseResources, or a pool") {
  const char* leaves = "a=R b=R c=R";
  CHECK(error_of("waits:d", kFair, leaves) ==
        "no UseResources 'd', there are: 'Test/Parallel/UseResources', "
        "'Test/Parallel/UseResources#2', 'Test/Parallel/UseResources#3', "
        "'Test/Parallel/UseResources/a', 'Test/Parallel/UseResources#2/b', "
        "'Test/Parallel/UseResources#3/c'");
  CHECK(error_of("waits:Parallel", kFair, leaves).starts_with("no UseResources 'Parallel', "));
  CHECK(error_of("waits:a", "ParallelRelative[delta=0](a b c)", leaves) == "no UseResources 'a'");
  CHECK(error_of("fairness:pp", kFair, leaves) == "no pool 'pp', did you mean 'p'?");
  CHECK(error_of("fairness:a", kFair, leaves) == "no pool 'a', there are: 'Test/p'");
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

TEST_CASE("a measure may be of one parallel or barrier") {
  constexpr auto kTree = "Sequence[memory=true](ParallelRelative[delta=1](a b) Parallel(c d))";
  constexpr auto kLeaves = "a+.1 b+.2 c+.25 d+.5";
  CHECK(measured("spread:ParallelRelative", kTree, kLeaves) == Approx(.5));
  CHECK(measured("spread:Sequence/Parallel", kTree, kLeaves) == Approx(.5));
  CHECK(measured("progress-distance:ParallelRelative", kTree, kLeaves) ==
        measured("progress-distance", kTree, kLeaves));
  CHECK(measured("progress-distance[0:1]:Sequence/Parallel", kTree, kLeaves) == Approx(.25));
  CHECK(measured("step-length:Sequence/Parallel", kTree, kLeaves) == Approx(.5));
  CHECK(measured("progress-distance-mean:Sequence/Parallel", kTree, kLeaves) == Approx(.25));
  CHECK(measured("progress-distance-seconds:Sequence/Parallel", kTree, kLeaves) == Approx(.1));
  CHECK(error_of("spread:three", kTree, kLeaves).starts_with("no parallel or barrier 'three'"));
  CHECK(error_of("spread:a", kTree, kLeaves).starts_with("no parallel or barrier 'a'"));
  CHECK(error_of("spread:", kTree, kLeaves) == "expected 'spread[:PATH]'");
}

TEST_CASE("a measure is written as it is read") {
  for (const char* text :
       {"progress-distance", "progress-distance[0:99]", "progress-distance[0:9]:pull/both",
        "progress-distance:both", "spread:both", "step-length:[1:2]", "held:pull/arm",
        "held-by:a:pull/arm", "held-by:\"a:b\":c", "held-by:a:\":\"\"\"", "waits:left/arm",
        "fairness:p", "entry:lap:2", "predictability:a@b@0.5", "predictability:a=1@0.5=10"}) {
    const auto spec = parse_measure(text);
    INFO(text);
    REQUIRE(spec);
    CHECK(to_text(*spec) == text);
  }
  CHECK(to_text(*parse_measure("predictability:a@0.50=1e1")) == "predictability:a@0.5=10");
  CHECK(to_text(*parse_measure("held-by:\"a\":\"b\"")) == "held-by:a:b");
  CHECK(parse_measure("held-by:\"a:\"\"b\":c")->name == "a:\"b");
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
  CHECK(label("held-by:arm:base") == "held by base (ticks)");
  CHECK(label("waits:arm") == "longest wait (ticks)");
  CHECK(label("fairness:arms") == "fairness index");
  CHECK(label("entry:lap") == "lap");
  CHECK(label("predictability:arm@0.6") == "instant of progress 0.6 (ticks)");
  CHECK(label("predictability:arm@0.6=3") == "predictability distance at 0.6 (ticks)");
}

TEST_CASE("an entry is measured when it is a number") {
  Shape tree{.id = "Main",
             .nodes = {{.path = "Main/a", .kind = "a", .name = "a"}},
             .entries = {{"lap", "int"}, {"part/lap", "double"}, {"name", "string"}}};
  const auto measure = [&](const char* text) {
    const MeasureSpec spec = parse_measure(text).value();
    Measuring measuring(tree, {&spec, 1});
    if (!measuring.error().empty()) return measuring.error();
    CHECK(measuring.columns()[0].node == "Main");
    CHECK(std::isnan(measuring.value(0, {})));  // no tick
    for (const double number : {7., 3.}) {
      Entry entries[2];
      entries[0].assign(Value(static_cast<std::int64_t>(number)));
      entries[1].assign(Value(std::numeric_limits<double>::infinity()));
      measuring.after_tick({.entries = entries});
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

TEST_CASE("what is generated: the table of the measures") {
  constexpr const char* kPage = "docs/studies.md";
  std::string table = "| Measure | Of | Meaning |\n";
  std::string docs = test::project_file(kPage);
  const auto begin = docs.find(table), end = docs.find("\n\n", begin);
  REQUIRE(end != std::string::npos);
  table += "|---|---|---|\n";
  for (const Measure* measure : all_measures()) {
    table.append("| `").append(measure->name).append(measure->argument).append("` | ");
    table.append(to_string(measure->of)).append(" | ").append(measure->doc).append(" |\n");
  }
  test::check_generated(kPage, docs.replace(begin, end + 1 - begin, table));
}

}  // namespace lockstep::host

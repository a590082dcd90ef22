// What is measured of a recording is what a study measures of the run.
#include "recording/use/recording_measures.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "recording/write/recorder.h"
#include "study/run_measures.h"
#include "unit/recording/watched_run.h"

namespace lockstep {
namespace {

using test::TemporaryPath;
using test::WatchedRun;

std::vector<MeasureSpec> all_measures(const std::string& node) {
  std::vector<MeasureSpec> measures;
  for (const std::string text :
       {"progress-distance", "step-length", "duration", "predictability:NODE@0.4=1"}) {
    std::string error;
    std::string spec = text;
    if (const auto at = spec.find("NODE"); at != spec.npos) spec.replace(at, 4, node);
    measures.push_back(parse_measure(spec, error).value());
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
};

}  // namespace

TEST_CASE("a recording has the measures of its run") {
  for (const Case& it : kCases) {
    INFO(it.law);
    const auto measures = all_measures("b");
    const TemporaryPath file;
    WatchedRun run(it.tree, it.leaves);
    Recorder recorder(run.run.tree(), {.path = file.path(), .tree_file = "a.xml", .rate_hz = 10});
    RunMeasures of_run(run.run.tree(), measures, 10);
    REQUIRE(of_run.error() == "");
    run.watch({&recorder, &of_run});

    std::istringstream text(file.text());
    RecordingReader reader(text, "run.jsonl");
    std::string error;
    const auto of_recording = measure_recording(reader, measures, error);
    CHECK(error == "");
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
      CHECK(to_text(measured.measure) == column.measure);
      CHECK(measured.node == column.node);
      const double expected = of_run.values()[i];
      CHECK((measured.value == expected || (std::isnan(measured.value) && std::isnan(expected))));
    }
    CHECK(at == of_recording.size());
    // Each measure has a number of its own, so that one cannot pass for another.
    for (std::size_t i = 1; i < of_recording.size(); ++i) {
      CHECK(of_recording[i].value != of_recording[i - 1].value);
    }
  }
}

TEST_CASE("a recording tells of a node that has succeeded and was ended in the same tick") {
  const TemporaryPath file;
  WatchedRun run(kCases[4].tree, kCases[4].leaves);
  Recorder recorder(run.run.tree(), {.path = file.path(), .tree_file = "a.xml", .rate_hz = 10});
  run.watch({&recorder});
  CHECK(file.text().find("],\"succeeded\":[2]}\n{\"end\"") != std::string::npos);
}

}  // namespace lockstep

// Any text as a recording: is read to its end or to an error, by each of those who read one, and
// they agree.
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "judge/measure/measure_spec.h"
#include "record/use/recording_csv.h"
#include "record/use/recording_diff.h"
#include "record/use/recording_info.h"
#include "record/use/recording_measures.h"
#include "show/view/replay/replay_view.h"

namespace fuzz_recording_target {
namespace {

using namespace lockstep::host;

void check(bool holds) {
  if (!holds) std::abort();
}

struct Recording {
  explicit Recording(const std::string& text) : in(text), reader(in, "fuzz.jsonl") {}

  std::istringstream in;
  RecordingReader reader;
};

// "" when the whole of it can be read.
std::string print(const std::string& text) {
  Recording csv(text), info(text);
  write_csv(csv.reader, [](std::string_view) { return true; });
  info_text(info.reader);
  check(csv.reader.error() == info.reader.error());
  if (csv.reader.error().empty()) check(!csv.reader.next() && !info.reader.next());
  return csv.reader.error();
}

void measure(const std::string& text) {
  std::vector<MeasureSpec> measures;
  for (const char* name : {"progress-distance", "step-length", "duration"})
    measures.push_back(*parse_measure(name));
  Recording recording(text);
  to_json(measure_recording(recording.reader, measures).value());
}

void compare_with_itself(const std::string& text) {
  Recording a(text), b(text);
  const RecordingDiff diff = compare(a.reader, b.reader, {});
  check(diff.same() && to_text(diff, "a", "b", false).empty());
}

// There and back: a moment is the same whichever way it is reached.
void replay(const std::string& text) {
  Recording recording(text);
  RecordingTimeline timeline(recording.reader, {.distance = 100, .most_memory = 1000});
  if (timeline.size() == 0) return;
  const DrawOptions options{.width = 40, .height = 10};
  const auto draw = [&] {
    const auto snapshot = snapshot_of(recording.reader.header(), timeline.now(), nullptr);
    const ReplayPlayer player(timeline, 1);
    draw_replay(recording.reader.header(), snapshot, player, options);
    draw_moment(recording.reader.header(), snapshot, timeline.now(), options);
  };
  const TimelineTick first = timeline.now();
  draw();
  timeline.go_to_end();
  const TimelineTick last = timeline.now();
  draw();
  timeline.step_back();
  timeline.step_forward();
  check(timeline.now() == last);
  timeline.go_to_tick(first.tick);
  check(timeline.now() == first && !timeline.failed());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (!print(text).empty()) return 0;
  measure(text);
  compare_with_itself(text);
  replay(text);
  return 0;
}

}  // namespace fuzz_recording_target

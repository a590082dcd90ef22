// The recordings of random runs that were cut and continued, read as one, are that of the run
// without a cut.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <memory>
#include <sstream>

#include "property/btcpp_tree.h"
#include "property/comparison.h"
#include "record/part_names.h"
#include "record/read/recorded_moments.h"
#include "record/read/recording_parts.h"
#include "record/read/recording_timeline.h"
#include "record/use/recording_events.h"
#include "record/use/recording_info.h"
#include "record/write/recorder.h"
#include "run/shape_of.h"
#include "support/tree_text.h"
#include "support/trials.h"
#include "unit/recording/watched_run.h"

namespace lockstep::host::test {
namespace {

const std::uint64_t kCutTrees = trials(200);

struct Cuttable {
  Tree tree;
  std::string leaves;
  std::uint64_t ticks = 0;
};

// Each fourth is for BehaviorTree.CPP, others pace or have barriers beside the tree.
std::optional<Cuttable> cuttable(std::uint64_t seed) {
  if (seed % 4 == 3) {
    const law::Document document = law::random_document(seed);
    return Cuttable{law::tree_of(document), law::leaves_text(document), 30};
  }
  const Trial trial = seed % 4 == 0   ? random_trial(seed)
                      : seed % 4 == 1 ? paced(random_trial(seed), seed)
                                      : random_group_trial(seed);
  auto tree = tree_of(trial).tree;
  if (!tree) return std::nullopt;
  return Cuttable{std::move(*tree), leaves_text(trial.plan), 30};
}

class SavedAtEnd : public Observer {
 public:
  explicit SavedAtEnd(const ScriptedRun& run) : run_(run) {}
  void standing(const Moment&) override { saved = run_.save(); }
  ScriptedRun::Saved saved;

 private:
  const ScriptedRun& run_;
};

// Records the ticks from the first one on, as a process that goes on from `state`, and saves that
// of its end. Returns how many ticks the run has had then; it has ended: UINT64_MAX.
std::uint64_t record_piece(const Cuttable& it, const std::string& path, std::uint64_t first,
                           std::uint64_t ticks, std::optional<ScriptedRun::Saved>& state) {
  WatchedRun piece(it.tree, it.leaves);
  if (state) piece.run.go_on_as(*state);
  piece.start.first_tick = first;
  piece.start.gap = from_seconds(first == 0 ? 0 : 2);
  SavedAtEnd saver(piece.run);
  Recorder recorder(shape_of(piece.run.tree()),
                    {.path = path, .run = {.tree_file = "a.xml", .rate_hz = 10}});
  const RunEnd end = piece.watch({&recorder, &saver}, ticks);
  state = saver.saved;
  return end.reason == StopReason::MaxTicks ? end.ticks : UINT64_MAX;
}

// As a kill leaves it.
void cut_closing_line(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  std::ofstream(path) << text.str().substr(0, text.str().rfind("{\"end\":"));
}

std::vector<std::string> ticks_in(std::istream& in) {
  RecordingReader reader(in, "recording");
  RecordedMoments moments(reader.header());
  std::vector<std::string> ticks;
  std::vector<NodeState> column;
  while (const auto tick = reader.next()) {
    const Moment& moment = moments.read(*tick);
    std::string text = fmt::format("{} {}:", moment.tick, moment.time.count());
    for (NodeIndex node = 0; node < moment.activity.size(); ++node) {
      const RecordedState& state = tick->nodes[node];
      text += fmt::format(" [{} {}{} {} {}", to_string(moment.status(node)), moment.ticked(node),
                          moment.held(node), moment.progress[node], state.progress);
      text += fmt::format(" {}/{} {} {}", state.round.number, state.round.of, state.factor,
                          moment.factors.empty() ? 1 : *moment.factors[node]);
      // Those of its last tick, which another process does not know.
      const auto kind = reader.header().nodes[node].synchronization;
      if (moment.ticked(node) || compares_progress(kind))
        text += fmt::format(" {}", moment.limit(node));
      if (moment.ticked(node)) text += fmt::format(" {}", moment.reason(node));
      for (const double used : moment.uses[node]) text += fmt::format(" {}", used);
      text += "]";
    }
    for (const RecordedEntry& entry : tick->entries)
      text += fmt::format(" {}:={}", entry.entry, shown_value(entry));
    for (std::size_t entry = 0; entry < moment.texts.size(); ++entry) {
      const EntryText& value = moment.texts[entry];
      text += fmt::format(" {}={}*{}", entry, value.text.value_or("-"), value.writes);
    }
    for (const NodeIndex node : moment.ended) text += fmt::format(" ended {}", node);
    tick->moments.each(column, [&](std::span<const NodeState> nodes, const TickMoment& at, bool) {
      text += fmt::format(" {} times", at.times);
      for (const NodeState node : nodes) text += fmt::format(" {}", node.bits);
    });
    ticks.push_back(text);
  }
  CHECK(reader.error() == "");
  CHECK(reader.cut() == "");
  return ticks;
}

std::vector<std::string> events_in(std::istream& in) {
  RecordingReader reader(in, "recording");
  std::vector<std::string> events;
  each_event(reader, {}, [&](const RecordingEvent& event) {
    events.push_back(event_line(event));
    return true;
  });
  return events;
}

std::vector<std::string> notes_in(std::istream& in) {
  RecordingReader reader(in, "recording");
  std::istringstream text(info_text(reader, false));
  std::vector<std::string> notes;
  for (std::string line; std::getline(text, line);) {
    if (line.find("note: ") != line.npos) notes.push_back(line);
  }
  return notes;
}

// See above of limits.
TimelineTick without_unknown(TimelineTick tick) {
  for (RecordedState& it : tick.nodes) it.limit = it.ticked ? it.limit : 0;
  return tick;
}

// Also back over the cuts.
void check_timelines(std::istream& one, std::istream& other, std::uint64_t ticks) {
  RecordingReader first(one, "uncut"), second(other, "cut");
  const TimelineOptions options{.distance = 1000};
  RecordingTimeline uncut(first, options), cut(second, options);
  REQUIRE(uncut.size() == cut.size());
  for (std::uint64_t i = 0; i < 2 * ticks; ++i) {
    const std::uint64_t tick = i * 7 % ticks;
    uncut.go_to_tick(tick);
    cut.go_to_tick(tick);
    INFO("the timeline at tick " << tick);
    REQUIRE(without_unknown(cut.now()) == without_unknown(uncut.now()));
  }
}

}  // namespace

TEST_CASE("the recordings of a run that was cut, read as one, are as if it was not", "[trials]") {
  std::uint64_t cuts = 0;
  for (std::uint64_t seed = 0; seed < kCutTrees; ++seed) {
    const auto it = cuttable(seed);
    if (!it) continue;
    INFO("seed " << seed);
    const TemporaryPath folder;
    const std::string uncut = folder.path() + ".uncut.jsonl", cut = folder.path();
    std::optional<ScriptedRun::Saved> state;
    record_piece(*it, uncut, 0, it->ticks, state);
    state.reset();
    std::uint64_t ticks = 0;
    std::string path;
    for (const std::uint64_t until : {1 + seed % 7, 6 + seed % 11, it->ticks}) {
      if (ticks >= until) continue;
      if (ticks > 0) cut_closing_line(path);
      path = name_of_resumed(cut);
      cuts += ticks > 0 ? 1 : 0;
      ticks = record_piece(*it, path, ticks, until, state);
    }
    NamedRecording one(uncut), other(cut);
    const auto expected = ticks_in(one.text()), found = ticks_in(other.text());
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) REQUIRE(found[i] == expected[i]);
    NamedRecording with_events(uncut), with_same(cut);
    REQUIRE(events_in(with_same.text()) == events_in(with_events.text()));
    NamedRecording with_notes(uncut), with_same_notes(cut);
    REQUIRE(notes_in(with_same_notes.text()) == notes_in(with_notes.text()));
    NamedRecording there(uncut), and_here(cut);
    check_timelines(there.text(), and_here.text(), expected.size());
  }
  CHECK(cuts > kCutTrees / 4);
}

}  // namespace lockstep::host::test

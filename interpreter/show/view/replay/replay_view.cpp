#include "show/view/replay/replay_view.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/wording.h"
#include "base/terminal/text_line.h"
#include "judge/summary/summary.h"
#include "show/view/lines_below.h"

namespace lockstep::host {
namespace {

constexpr unsigned kStatusLines = 2;
constexpr std::size_t kLogLines = 3;  // the live view prints them above the tree

TextLine new_line(const DrawOptions& options) {
  return {options.width, options.color, options.unicode};
}

std::string fault_text(const Shape& shape, const RecordedFault& fault) {
  return fmt::format("fault: {}: {}", shape.nodes[fault.node].segment, fault.message);
}

// What nodes returned before the state that is shown: "grasped: failure, success".
template <class Add>
void each_result(const TimelineTick& moment, const Add& add) {
  for (NodeIndex node = 0; node < moment.results.size(); ++node) {
    if (!moment.results[node].empty()) add(node, moment.results[node]);
  }
}

constexpr std::string_view kWithin = "within this tick: ";

// A line for all of them; empty: the tick has one moment.
std::string results_line(const Shape& shape, const TimelineTick& moment,
                         const DrawOptions& options) {
  TextLine line = new_line(options);
  std::string_view between = kWithin;
  each_result(moment, [&](NodeIndex node, const std::string& results) {
    line.add(fmt::format("{}{}: {}", between, shape.nodes[node].segment, results), Style::Active);
    between = "; ";
  });
  return between == kWithin ? std::string() : line.text() + "\n";
}

std::string where(const ReplayPlayer& player) {
  const RecordingTimeline& timeline = player.timeline();
  return fmt::format("  tick {} of {}  {:.3f} of {:.3f} s  speed {:.6g}", timeline.now().tick,
                     timeline.last_tick(), timeline.now().time, timeline.last_time(),
                     player.speed());
}

RunResult result_of(const RecordedEnd& end) {
  for (const RunResult result :
       {RunResult::Success, RunResult::Failure, RunResult::Fault, RunResult::Skipped}) {
    if (end.result == to_string(result)) return result;
  }
  return RunResult::Stopped;
}

void add_warnings(TextLine& line, const Shape& shape, const RecordingTimeline& timeline) {
  const TimelineTick& now = timeline.now();
  if (now.lost > 0) {
    line.add("  ");
    line.add(counted(now.lost, "tick") + " lost before this", Style::Warning);
  }
  if (timeline.at_end() && !timeline.outcome().error.empty()) {
    line.add("  ");
    line.add("damaged after this", Style::Bad);
  } else if (timeline.at_end() && !timeline.outcome().cut.empty()) {
    line.add("  ");
    line.add("the recording is cut here", Style::Warning);
  }
  if (!now.faults.empty()) {
    line.add("  ");
    line.add(fault_text(shape, now.faults.front()), Style::Bad);
    if (now.faults.size() > 1) line.add(fmt::format(" and {} more", now.faults.size() - 1));
  }
}

void add_keys(TextLine& line, const ReplayPlayer& player, const DrawOptions& options) {
  if (player.typed()) {
    line.add(fmt::format("go to tick: {}_", *player.typed()), Style::Strong);
  } else if (!player.notice().empty()) {
    line.add(player.notice(), Style::Warning);
  } else {
    line.add(fmt::format("space {}  {} step  g go to tick  home end  + - speed  q quit",
                         player.paused() ? "continue" : "pause", options.unicode ? "← →" : "p n"),
             Style::Dim);
  }
}

}  // namespace

Snapshot snapshot_of(const RecordingHeader& header, const TimelineTick& moment,
                     const RecordedEnd* end) {
  Snapshot snapshot{.header = {.rate_hz = header.rate_hz,
                               .real_time = header.clock != "virtual",
                               .tick = moment.tick,
                               .time = from_seconds(moment.time),
                               .overruns = {},
                               .result = {}},
                    .nodes = std::vector<NodeView>(moment.nodes.size()),
                    .entries = moment.past.entries,
                    .logs = moment.past.logs,
                    .heard = moment.past.heard};
  snapshot.entries.resize(header.entries.size());
  if (end != nullptr) {
    snapshot.header.result = result_of(*end);
    for (const LeafLine& line : end->logs) snapshot.logs.add(line);
  }
  for (NodeIndex node = 0; node < snapshot.nodes.size(); ++node) {
    const RecordedState& state = moment.nodes[node];
    NodeView& view = snapshot.nodes[node];
    view.limit = state.limit;
    view.round = state.round;
    view.activity = state.held ? Activity::Paused : static_cast<Activity>(state.status);
    if (header.nodes[node].keeper) {
      view.progress = shown_progress(view.activity, state.progress);
      view.factor = state.factor;
    }
  }
  return snapshot;
}

std::string draw_moment(const Shape& shape, const Snapshot& snapshot, const TimelineTick& moment,
                        const DrawOptions& options) {
  DrawOptions tree = options;
  tree.entries = 0;  // they follow, without the ticks of their changes: a part does not have these
  std::string text = draw(shape, snapshot, tree);
  for (const RecordedFault& fault : moment.faults) {
    TextLine line = new_line(options);
    line.add(fault_text(shape, fault), Style::Bad);
    text += line.text() + "\n";
  }
  each_result(moment, [&](NodeIndex node, const std::string& results) {
    TextLine line = new_line(options);
    line.add(fmt::format("{}{}: {}", kWithin, shape.nodes[node].path, results));
    text += line.text() + "\n";
  });
  for (std::size_t entry = 0; entry < snapshot.entries.size(); ++entry) {
    const EntryState& state = snapshot.entries[entry];
    if (!state.changed) continue;
    const std::optional<std::string> value =
        state.is_long ? std::nullopt : std::optional(state.text);
    TextLine line = new_line(options);
    line.add(shape.entries[entry].key + " = " + shown_value({.value = value}));
    text += line.text() + "\n";
  }
  for (const LeafLine& log : moment.logs) text += log_line(log, options);
  return text;
}

std::string draw_replay(const Shape& shape, const Snapshot& snapshot, const ReplayPlayer& player,
                        const DrawOptions& options) {
  const std::string results = results_line(shape, player.timeline().now(), options);
  DrawOptions above = options;
  above.height -= std::min(above.height, kStatusLines + (results.empty() ? 0u : 1u));
  above.logs = kLogLines;
  TextLine status = new_line(options);
  status.add(player.paused() ? (player.timeline().at_end() ? "end" : "paused") : "plays",
             player.paused() ? Style::Warning : Style::Active);
  status.add(where(player));
  add_warnings(status, shape, player.timeline());
  TextLine keys = new_line(options);
  add_keys(keys, player, options);
  return draw(shape, snapshot, above) + results + status.text() + "\n" + keys.text() + "\n";
}

}  // namespace lockstep::host

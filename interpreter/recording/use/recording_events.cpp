#include "recording/use/recording_events.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/csv_field.h"
#include "json/json.h"

namespace lockstep::host {
namespace {

// "": its status has not changed so that anything began or ended.
std::string_view change_of(Status before, Status now) {
  if (now == before) return {};
  if (now == Status::Running) return "start";
  if (now == Status::Idle) return before == Status::Running ? "halt" : "";
  return to_string(now);
}

class Events {
 public:
  Events(const RecordingHeader& header, TickRange range, const EventSink& take)
      : header_(header), range_(range), take_(take), before_(header.nodes.size()) {}

  // False: no more is wanted.
  bool take(const RecordedTick& tick) {
    at_ = {tick.tick, tick.time, {}, {}, {}};
    const bool is_first = next_ == 0 && tick.tick > 0 && tick.whole;
    if (!is_first && tick.tick > next_) {
      add("lost", "", fmt::format("{} from {} on", tick.tick - next_, next_));
    }
    next_ = tick.tick + 1;
    if (is_first) {  // what changed with it is not known
      before_.assign(tick.nodes.begin(), tick.nodes.end());
      return true;
    }
    for (NodeIndex node = 0; node < before_.size(); ++node) add_node(node, tick.nodes);
    for (const RecordedFault& it : tick.faults)
      add("fault", header_.nodes[it.node].path, it.message);
    for (const RecordedEntry& it : tick.entries) {
      add("entry", header_.entries[it.entry].key, shown_value(it));
    }
    for (const LeafLine& it : tick.logs) add("log", it.who, it.level + ": " + it.text);
    before_.assign(tick.nodes.begin(), tick.nodes.end());
    return is_wanted_;
  }

  void take(const RecordedEnd& end) {
    at_ = {end.ticks, end.time, {}, {}, {}};
    for (const LeafLine& it : end.logs) add("log", it.who, it.level + ": " + it.text);
    add("end", "", fmt::format("{} ({})", end.result, end.reason));
  }

 private:
  void add_node(NodeIndex node, std::span<const RecordedState> now) {
    const RecordedNode& it = header_.nodes[node];
    const bool is_group = !it.members.empty() || !it.resources.empty();
    if (is_group) return;  // it runs as long as it has members
    const RecordedState &before = before_[node], &state = now[node];
    // A node below a held one is held with it.
    const bool is_below = it.parent && now[*it.parent].held;
    const bool was_below = it.parent && before_[*it.parent].held;
    const bool goes_on = before.held && !state.held && state.status != Status::Idle;
    if (goes_on && !was_below) add("release", it.path, "");
    if (const auto change = change_of(before.status, state.status); !change.empty()) {
      add(change, it.path, "");
    }
    if (state.held && !before.held && !is_below) add("hold", it.path, "");
  }

  void add(std::string_view kind, std::string_view what, std::string value) {
    if (at_.tick < range_.from || !is_wanted_) return;
    at_.kind = kind;
    at_.what = what;
    at_.value = std::move(value);
    is_wanted_ = take_(at_);
  }

  const RecordingHeader& header_;
  const TickRange range_;
  const EventSink& take_;
  std::vector<RecordedState> before_;
  RecordingEvent at_;
  std::uint64_t next_ = 0;  // tick
  bool is_wanted_ = true;
};

}  // namespace

void each_event(RecordingReader& reader, TickRange range, const EventSink& take) {
  Events events(reader.header(), range, take);
  // The tick before it tells what changed with a tick.
  if (range.from > 1) reader.skip_to(range.from - 1);
  bool is_wanted = true;
  while (is_wanted) {
    const auto tick = reader.next();
    if (!tick) break;
    is_wanted = tick->tick <= range.to && events.take(*tick);
  }
  if (is_wanted && reader.end()) events.take(*reader.end());
}

std::string event_line(const RecordingEvent& event) {
  std::string line =
      fmt::format("{:>10.3f} s  tick {:<8} {:<8}", event.time, event.tick, event.kind);
  if (!event.what.empty()) (line += ' ') += event.what;
  if (!event.value.empty()) ((line += event.what.empty() ? " " : ": ")) += event.value;
  return line;
}

std::string event_csv(const RecordingEvent& event) {
  return fmt::format("{},{},{},{},{}", event.tick, event.time, event.kind,
                     csv_field(std::string(event.what)), csv_field(event.value));
}

std::string event_json(const RecordingEvent& event) {
  return Json{{"tick", event.tick},
              {"time_s", event.time},
              {"event", event.kind},
              {"what", event.what},
              {"value", event.value}}
      .text();
}

}  // namespace lockstep::host

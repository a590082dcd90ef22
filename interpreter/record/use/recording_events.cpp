#include "record/use/recording_events.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/core/csv_field.h"
#include "base/core/synchronization.h"
#include "base/json/json.h"
#include "record/use/recording_merge.h"
#include "trace/completion.h"

namespace lockstep::host {
namespace {

EventKind result_event(Status result) {
  return result == Status::Success   ? EventKind::Success
         : result == Status::Failure ? EventKind::Failure
                                     : EventKind::Skipped;
}

// None: nothing began or ended.
std::optional<EventKind> change_of(NodeState was, NodeState is) {
  const Status before = was.status(), now = is.status();
  if (now == before && !completes_newly(was, is)) return std::nullopt;
  if (now == Status::Running) return EventKind::Start;
  if (now != Status::Idle) return result_event(now);
  return before == Status::Running ? std::optional(EventKind::Halt) : std::nullopt;
}

class Events {
 public:
  Events(const RecordingHeader& header, TickRange range, const EventSink& take)
      : header_(header),
        range_(range),
        take_(take),
        before_(header.nodes.size()),
        is_told_held_(header.nodes.size()) {
    const bool paces = std::ranges::any_of(header.nodes, &ShapeNode::paces);
    factors_.assign(paces ? header.nodes.size() : 0, 1);
    for (NodeIndex node = 0; node < header.nodes.size(); ++node) {
      if (header.nodes[node].question) questions_.push_back({.node = node});
    }
    if (!is_merged(header)) return;
    for (NodeIndex node = 0; node < header.nodes.size(); ++node) {
      const auto parent = header.nodes[node].parent;
      robot_of_.push_back(!parent || *parent == 0 ? node : robot_of_[*parent]);
    }
  }

  // False: no more is wanted. How fast a node is to be comes last: what follows from a tick.
  bool take(const RecordedTick& tick) {
    at_ = {tick.tick, tick.time, {}, {}, {}};
    const bool is_first = next_ == 0 && tick.tick > 0 && tick.whole;
    if (!is_first && tick.tick > next_) {
      add(EventKind::Lost, "", fmt::format("{} from {} on", tick.tick - next_, next_));
    }
    next_ = tick.tick + 1;
    now_.clear();
    for (const RecordedState& it : tick.nodes) now_.push_back(it.state());
    keep_others(now_);
    for (const RecordedEntry& it : tick.given) {  // from outside, before the tick
      if (!is_first) add(EventKind::Entry, header_.entries[it.entry].key, shown_value(it));
    }
    if (is_first) {
      for (NodeIndex node = 0; node < now_.size(); ++node) {  // what changed with it is not known
        is_told_held_[node] = is_held_itself(node, now_);
      }
    } else if (tick.moments.empty()) {
      for (NodeIndex node = 0; node < before_.size(); ++node) add_node(node, now_);
    } else {
      add_moments(tick.moments);
    }
    for (const RecordedFault& it : tick.faults)
      add(EventKind::Fault, header_.nodes[it.node].path, it.message);
    for (const GivenAnswer& it : tick.answers) {
      add(EventKind::Answer, header_.nodes[it.node].path,
          fmt::format("{} (by {})", it.answer, it.who));
    }
    add_questions(tick, is_first);
    for (const RecordedEntry& it : tick.entries) {
      if (!is_first) add(EventKind::Entry, header_.entries[it.entry].key, shown_value(it));
    }
    for (const LeafLine& it : tick.logs) add(EventKind::Log, it.who, it.level + ": " + it.text);
    for (NodeIndex node = 0; node < factors_.size(); ++node) {
      const double factor = tick.nodes[node].factor;
      if (std::exchange(factors_[node], factor) == factor || is_first) continue;
      add(EventKind::Pace, header_.nodes[node].path, fmt::format("{:.3g}", factor));
    }
    before_ = now_;
    return is_wanted_;
  }

  void take(const RecordedEnd& end) {
    at_ = {end.ticks, end.time, {}, {}, {}};
    for (const LeafLine& it : end.logs) add(EventKind::Log, it.who, it.level + ": " + it.text);
    add(EventKind::End, "", fmt::format("{} ({})", end.result, end.reason));
  }

 private:
  // A node asks with each text that it did not have before: it has none after each activation. The
  // line after a cut has the same text again, or none: one that is held asks later, or has its
  // answer.
  void add_questions(const RecordedTick& tick, bool is_first) {
    for (Question& it : questions_) {
      const auto reason = std::ranges::find(tick.reasons, it.node, &RecordedReason::node);
      if (reason != tick.reasons.end() && std::exchange(it.text, reason->text) != reason->text)
        it.is_told = false;
      if (now_[it.node].status() != Status::Running || it.text.empty()) continue;
      if (!std::exchange(it.is_told, true) && !is_first)
        add(EventKind::Ask, header_.nodes[it.node].path, it.text);
    }
  }

  // A tick of one robot is not between two ticks of another one.
  void keep_others(std::vector<NodeState>& now) const {
    for (std::size_t node = robot_of_.size(); node-- > 0;) {  // a robot after its nodes
      if (!now[robot_of_[node]].ticked()) now[node] = before_[node];
    }
  }

  bool is_group(const ShapeNode& it) const {  // it runs as long as it has members
    return !it.members.empty() || !it.resources.empty();
  }

  void add_node(NodeIndex node, std::span<const NodeState> now, std::uint64_t times = 0) {
    const ShapeNode& it = header_.nodes[node];
    if (is_group(it)) return;
    const NodeState before = before_[node], state = now[node];
    const bool is_over = is_told_held_[node] && !state.held();
    if (is_over) is_told_held_[node] = false;
    if (is_over && state.status() != Status::Idle) add(EventKind::Release, it.path, "");
    if (times > 0 && state.ticked() && has_ended(state.status())) {
      add_result(it, state.status(), times);
    } else if (const auto change = change_of(before, state)) {
      add(*change, it.path, "");
    }
    if (!is_told_held_[node] && is_held_itself(node, now)) {
      is_told_held_[node] = true;
      add(EventKind::Hold, it.path, "");
    }
  }

  // A node below a held one is held with it.
  bool is_held_itself(NodeIndex node, std::span<const NodeState> now) const {
    const ShapeNode& it = header_.nodes[node];
    return now[node].held() && !is_group(it) && !(it.parent && now[*it.parent].held());
  }

  // In such a tick each result is an event, also one that is as the one before.
  void add_moments(const MomentsView& moments) {
    moments.each(moment_, [&](std::span<const NodeState> now, const TickMoment& it, bool) {
      seen_.assign(now.begin(), now.end());
      keep_others(seen_);
      for (NodeIndex node = 0; node < seen_.size(); ++node) add_node(node, seen_, it.times);
      before_ = seen_;
    });
    for (const NodeTotals& it : moments.rest) {
      const ShapeNode& node = header_.nodes[it.node];
      if (is_group(node)) continue;
      for (const Status result : {Status::Success, Status::Failure, Status::Skipped}) {
        if (it.of(result) > 0) add_result(node, result, it.of(result));
      }
    }
  }

  void add_result(const ShapeNode& node, Status result, std::uint64_t times) {
    add(result_event(result), node.path, times == 1 ? "" : fmt::format("{} times", times));
  }

  void add(EventKind kind, std::string_view what, std::string value) {
    if (at_.tick < range_.from || !is_wanted_) return;
    at_.kind = kind;
    at_.what = what;
    at_.value = std::move(value);
    is_wanted_ = take_(at_);
  }

  struct Question {  // of a node that asks
    NodeIndex node = 0;
    std::string text = {};
    bool is_told = false;
  };

  const RecordingHeader& header_;
  const TickRange range_;
  const EventSink& take_;
  std::vector<NodeState> before_, now_, moment_, seen_;
  std::vector<NodeIndex> robot_of_;  // of each node, in the recording of a team
  std::vector<bool> is_told_held_;   // it has a hold, and no release yet
  std::vector<double> factors_;
  std::vector<Question> questions_;
  RecordingEvent at_;
  std::uint64_t next_ = 0;  // tick
  bool is_wanted_ = true;
};

// Whether a node that may be held is below another one: of a tick alone it is not known which of
// them were held before the other.
bool holds_in_holds(const RecordingHeader& header) {
  std::vector<bool> may_be_held(header.nodes.size()), is_in_held(header.nodes.size());
  for (const ShapeNode& it : header.nodes) {
    if (!compares_progress(it.synchronization) && !it.is_pool()) continue;
    for (const NodeIndex child : it.held()) may_be_held[child] = true;
  }
  for (NodeIndex node = 0; node < header.nodes.size(); ++node) {
    const auto parent = header.nodes[node].parent;
    is_in_held[node] = parent && (is_in_held[*parent] || may_be_held[*parent]);
    if (is_in_held[node] && may_be_held[node]) return true;
  }
  return false;
}

}  // namespace

void each_event(RecordingReader& reader, TickRange range, const EventSink& take) {
  Events events(reader.header(), range, take);
  // The tick before it tells what changed with a tick.
  if (range.from > 1 && !holds_in_holds(reader.header())) reader.skip_to(range.from - 1);
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
      fmt::format("{:>10.3f} s  tick {:<8} {:<8}", event.time, event.tick, to_string(event.kind));
  if (!event.what.empty()) (line += ' ') += event.what;
  if (!event.value.empty()) ((line += event.what.empty() ? " " : ": ")) += event.value;
  return line;
}

std::string event_csv(const RecordingEvent& event) {
  return fmt::format("{},{},{},{},{}", event.tick, event.time, to_string(event.kind),
                     csv_field(std::string(event.what)), csv_field(event.value));
}

std::string event_json(const RecordingEvent& event) {
  return Json{{"tick", event.tick},
              {"time_s", event.time},
              {"event", to_string(event.kind)},
              {"what", event.what},
              {"value", event.value}}
      .text();
}

}  // namespace lockstep::host

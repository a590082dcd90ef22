#include "record/read/recording_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "base/core/resource_set.h"
#include "base/core/wording.h"
#include "record/lines.h"
#include "run/shape_of.h"

namespace lockstep::host {
namespace {

auto into_seconds(double& time) {
  return [&time](JsonValue value) {
    constexpr double kMost = 9e9;  // fits into nanoseconds
    time = value.number();
    if (!(time >= 0 && time <= kMost)) throw JsonError("'time_s' is not a time in seconds");
  };
}

NodeIndex node_from(JsonValue value, std::size_t nodes, const char* otherwise) {
  std::uint64_t node = 0;
  if (!value.get(node)) throw JsonError(otherwise);
  if (node < nodes) return static_cast<NodeIndex>(node);
  throw JsonError(fmt::format("no node {}, expected 0 to {}", node, nodes - 1));
}

// "idle, running, …"
std::string status_names() {
  std::string text;
  for (const StatusRow& row : kStatuses) {
    if (!text.empty()) text += row.status == kLastStatus ? " or " : ", ";
    text += row.name;
  }
  return text;
}

Status status_from(JsonValue value) {
  std::string_view text;
  if (!value.get(text)) throw JsonError("a node's change has a status that is not a string");
  for (const StatusRow& row : kStatuses) {
    if (text == row.name) return row.status;
  }
  throw JsonError(fmt::format("no status '{}', expected {}", brief(text), status_names()));
}

double progress_from(JsonValue value) {
  double progress = 0;
  if (value.get(progress) && progress >= 0 && progress <= 1) return progress;
  throw JsonError("a node's change has a progress that is not in [0, 1]");
}

bool flag_from(JsonValue value) {
  std::uint64_t flag = 0;
  if (value.get(flag) && flag <= 1) return flag == 1;
  throw JsonError("a node's change has a flag that is neither 0 nor 1");
}

// Reads a list of so many items; `take` gets each with its place. Else throws `why`.
template <class Take>
void read_tuple(JsonValue value, std::size_t count, const char* why, Take take) {
  if (!value.is_list()) throw JsonError(why);
  std::size_t place = 0;
  value.each_item([&](JsonValue item) {
    if (place == count || !take(place++, item)) throw JsonError(why);
  });
  if (place != count) throw JsonError(why);
}

// Each of these gives the node that has changed.
NodeIndex apply(JsonValue change, std::vector<RecordedState>& states) {
  constexpr char kNone[] = "a node's change is not [index, status, progress, ticked, held]";
  NodeIndex node = 0;
  RecordedState state;
  read_tuple(change, 5, kNone, [&](std::size_t place, JsonValue item) {
    switch (place) {
      case 0:
        node = node_from(item, states.size(), kNone);
        break;
      case 1:
        state.status = status_from(item);
        break;
      case 2:
        state.progress = progress_from(item);
        break;
      case 3:
        state.ticked = flag_from(item);
        break;
      default:
        state.held = flag_from(item);
    }
    return true;
  });
  state.limit = states[node].limit;
  state.round = states[node].round;
  state.factor = states[node].factor;
  states[node] = state;
  return node;
}

NodeIndex apply_round(JsonValue change, std::vector<RecordedState>& states) {
  constexpr char kNone[] = "a node's round is not [index, number, of]";
  std::uint64_t fields[3] = {};
  NodeIndex node = 0;
  read_tuple(change, 3, kNone, [&](std::size_t place, JsonValue item) {
    if (place == 0) node = node_from(item, states.size(), kNone);
    return place == 0 || (item.get(fields[place]) && fields[place] <= INT64_MAX);
  });
  states[node].round = {static_cast<std::int64_t>(fields[1]), static_cast<std::int64_t>(fields[2])};
  return node;
}

NodeIndex apply_factor(JsonValue change, std::vector<RecordedState>& states) {
  constexpr char kNone[] = "a node's factor is not [index, factor]";
  NodeIndex node = 0;
  double factor = 1;
  read_tuple(change, 2, kNone, [&](std::size_t place, JsonValue item) {
    if (place == 0) node = node_from(item, states.size(), kNone);
    return place == 0 || (item.get(factor) && factor > 0 && factor <= 1);
  });
  states[node].factor = factor;
  return node;
}

// The limit of a UseResources is a set of resources, negative when it waits for them; or two sets.
bool is_limit(double limit, bool is_set) {
  if (!is_set) return limit >= 0 && limit <= 1;
  constexpr auto kEnd = static_cast<double>(ResourceSet{1} << kMaxResources);
  constexpr auto kBoth = static_cast<double>(kOwnsAndWaits);
  const bool has_both = limit <= -kBoth && limit > -2 * kBoth;
  return (std::fabs(limit) < kEnd || has_both) && std::trunc(limit) == limit;
}

// Null: no barrier is left.
NodeIndex apply_limit(JsonValue change, const std::vector<bool>& users,
                      std::vector<RecordedState>& states) {
  constexpr char kNone[] = "a node's limit is not [index, number in [0, 1] or null]";
  constexpr char kNoSet[] = "the limit of a UseResources is not [index, set of resources]";
  NodeIndex node = 0;
  double limit = std::numeric_limits<double>::infinity();
  read_tuple(change, 2, kNone, [&](std::size_t place, JsonValue item) {
    if (place == 0) {
      node = node_from(item, states.size(), kNone);
    } else if (users[node]) {
      if (!item.get(limit) || !is_limit(limit, true)) throw JsonError(kNoSet);
    } else {
      return item.is_null() || (item.get(limit) && is_limit(limit, false));
    }
    return true;
  });
  states[node].limit = limit;
  return node;
}

MomentChange moment_node_from(JsonValue value, std::size_t nodes) {
  constexpr char kNone[] = "a node of a moment is not [index, status, ticked, held]";
  MomentChange change;
  Status status = Status::Idle;
  bool flags[2] = {};
  read_tuple(value, 4, kNone, [&](std::size_t place, JsonValue item) {
    if (place == 0) {
      change.node = node_from(item, nodes, kNone);
    } else if (place == 1) {
      status = status_from(item);
    } else {
      flags[place - 2] = flag_from(item);
    }
    return true;
  });
  const bool is_held = flags[1] && status == Status::Running;
  change.before =
      NodeState::of(is_held ? Activity::Paused : static_cast<Activity>(status), flags[0]);
  return change;
}

TickMoment moment_from(JsonValue value, std::size_t nodes, std::vector<MomentChange>& changes) {
  TickMoment moment;
  read_tuple(value, 2, "a moment is not [times, nodes]", [&](std::size_t place, JsonValue item) {
    if (place == 0) return item.get(moment.times) && moment.times != 0;
    if (!item.is_list()) return false;
    item.each_item([&](JsonValue it) { changes.push_back(moment_node_from(it, nodes)); });
    return true;
  });
  moment.changes = static_cast<std::uint32_t>(changes.size());
  return moment;
}

LeafProgress leaf_progress_from(JsonValue value, std::size_t nodes) {
  constexpr char kNone[] = "leaf_progress is not [moment, index, progress]";
  LeafProgress progress;
  read_tuple(value, 3, kNone, [&](std::size_t place, JsonValue item) {
    if (place == 0) return item.get(progress.moment);
    if (place == 1) progress.node = node_from(item, nodes, kNone);
    return place == 1 ||
           (item.get(progress.progress) && progress.progress >= 0 && progress.progress <= 1);
  });
  return progress;
}

NodeTotals totals_from(JsonValue value, std::size_t nodes) {
  constexpr char kNone[] =
      "counts are not [index, succeeded, failed, skipped, halted, held, faults]";
  NodeTotals totals;
  read_tuple(value, NodeTotals::kKinds + 2, kNone, [&](std::size_t place, JsonValue item) {
    std::uint64_t count = 0;
    if (place == 0) {
      totals.node = node_from(item, nodes, kNone);
    } else if (!item.get(count)) {
      return false;
    } else if (place <= NodeTotals::kKinds) {
      totals.counts[place - 1] = count;
    }
    return true;
  });
  return totals;
}

// A node and a text. `none` is the message where the value is no such thing.
template <class Item, auto Text>
Item text_of_node_from(JsonValue value, std::size_t nodes, const char* none) {
  Item found;
  read_tuple(value, 2, none, [&](std::size_t place, JsonValue item) {
    std::string_view text;
    if (place == 0) {
      found.node = node_from(item, nodes, none);
    } else if (item.get(text)) {
      found.*Text = text;
    } else {
      return false;
    }
    return true;
  });
  return found;
}

std::uint32_t key_from(JsonValue value, std::size_t keys, const char* otherwise) {
  std::uint64_t number = 0;
  if (!value.get(number)) throw JsonError(otherwise);
  if (number < keys) return static_cast<std::uint32_t>(number);
  throw JsonError(fmt::format("no entry {}, the header has {}", number, keys));
}

GivenAnswer answer_from(JsonValue value, std::size_t nodes) {
  constexpr char kNone[] = "an answer is not [index, answer, who]";
  GivenAnswer found;
  read_tuple(value, 3, kNone, [&](std::size_t place, JsonValue item) {
    std::string_view text;
    if (place == 0) {
      found.node = node_from(item, nodes, kNone);
    } else if (item.get(text)) {
      (place == 1 ? found.answer : found.who) = text;
    } else {
      return false;
    }
    return true;
  });
  return found;
}

RecordedHeard heard_from(JsonValue value, std::size_t nodes) {
  constexpr char kNone[] = "what is heard is not [index, run, word]";
  RecordedHeard found;
  read_tuple(value, 3, kNone, [&](std::size_t place, JsonValue item) {
    std::uint64_t number = 0;
    if (place == 0) {
      found.node = node_from(item, nodes, kNone);
    } else if (!item.get(number) || (place == 1 && number > UINT32_MAX)) {
      return false;
    } else if (place == 1) {
      found.run = static_cast<std::uint32_t>(number);
    } else {
      found.word = number;
    }
    return true;
  });
  return found;
}

RecordedEntry entry_from(JsonValue value, std::size_t keys) {
  constexpr char kNone[] = "an entry is not [index, text or null]";
  RecordedEntry entry;
  read_tuple(value, 2, kNone, [&](std::size_t place, JsonValue item) {
    std::string_view text;
    if (place == 0) {
      entry.entry = key_from(item, keys, kNone);
      return true;
    }
    if (item.get(text)) entry.value = text;
    return entry.value || item.is_null();
  });
  return entry;
}

LeafLine log_from(JsonValue value) {
  LeafLine log;
  std::string* const fields[] = {&log.who, &log.level, &log.text};
  read_tuple(value, std::size(fields), "a log line is not [who, level, text]",
             [&](std::size_t place, JsonValue item) {
               std::string_view text;
               if (!item.get(text)) return false;
               *fields[place] = text;
               return true;
             });
  return log;
}

auto into_logs(std::vector<LeafLine>& logs) {
  return [&logs](JsonValue value) {
    constexpr std::size_t kMost = 1000;  // a recorder leaves out more
    value.each_item([&](JsonValue it) {
      if (logs.size() == kMost) throw JsonError(fmt::format("more than {} log lines", kMost));
      logs.push_back(log_from(it));
    });
  };
}

RecordedGap gap_from(JsonObject object) {
  RecordedGap gap;
  object.read({{lines::kLost["ticks"], into(gap.ticks)}, {lines::kLost["from"], into(gap.from)}});
  constexpr std::uint64_t kMost = std::uint64_t{1} << 63u;  // ticks of a run
  if (gap.ticks > 0 && gap.ticks <= kMost && gap.from <= kMost - gap.ticks) return gap;
  throw JsonError(fmt::format("{} ticks cannot be lost from tick {} on", gap.ticks, gap.from));
}

// More than a summary shows: of many short ones each would take far more than its length.
auto into_notes(std::vector<std::string>& notes) {
  return [&notes](JsonValue value) {
    constexpr std::size_t kMost = 1000;
    std::size_t more = 0;
    value.each_item([&](JsonValue item) {
      const std::string_view note = item.text();
      if (notes.size() < kMost) {
        notes.emplace_back(note);
      } else {
        ++more;
      }
    });
    if (more > 0) notes.push_back(fmt::format("and {} more", counted(more, "note")));
  };
}

template <class Value>
auto into_end(Value& value) {
  return into(value);
}
auto into_end(std::optional<std::uint64_t>& number) {
  return [&number](JsonValue value) { number = value.whole(); };
}
auto into_end(double& time) {
  return into_seconds(time);
}
auto into_end(std::vector<std::string>& notes) {
  return into_notes(notes);
}
auto into_end(std::vector<LeafLine>& logs) {
  return into_logs(logs);
}

RecordedEnd end_from(JsonObject object) {
  RecordedEnd end;
  std::vector<JsonField> fields;
  lines::each_member(lines::kEnd, end, [&](const lines::Field& field, auto& value) {
    fields.push_back({field.key, into_end(value), field.has == lines::kMaybe});
  });
  object.read(fields);
  return end;
}

}  // namespace

// Each moment says what differs from the one after it, so they are made from the last one back to
// the first; the changes then lead forward.
MomentsView RecordingJson::moments(const std::vector<RecordedState>& states) {
  if (moments_.empty()) return {.progress = leaf_progress_};
  first_moment_.clear();
  for (const RecordedState& it : states) first_moment_.push_back(it.state());
  for (NodeTotals& it : totals_) it.after = first_moment_[it.node];
  for (std::size_t i = moment_changes_.size(); i-- > 0;) {
    MomentChange& it = moment_changes_[i];
    it.after = std::exchange(first_moment_[it.node], it.before);
  }
  return {first_moment_, moments_, moment_changes_, totals_, leaf_progress_};
}

RecordingJson::Line RecordingJson::line(std::string& line, std::vector<RecordedState>& states) {
  std::optional<RecordedEnd> end;
  std::optional<RecordedGap> gap;
  std::optional<RecordedPartEnd> part_end;
  std::optional<std::uint64_t> tick;
  std::optional<double> time;
  bool has_nodes = false, is_whole = false;
  changed_.clear();
  reasons_.clear();
  answers_.clear();
  heard_.clear();
  faults_.clear();
  whole_.clear();
  succeeded_.clear();
  moments_.clear();
  moment_changes_.clear();
  totals_.clear();
  leaf_progress_.clear();
  entries_.clear();
  set_.clear();
  given_.clear();
  logs_.clear();
  const auto read_nodes = [&](JsonValue value) {
    has_nodes = true;
    value.each_item([&](JsonValue change) { changed_.push_back(apply(change, states)); });
  };
  const auto read_limits = [&](JsonValue value) {
    value.each_item(
        [&](JsonValue change) { changed_.push_back(apply_limit(change, users_, states)); });
  };
  const auto read_rounds = [&](JsonValue value) {
    value.each_item([&](JsonValue change) { changed_.push_back(apply_round(change, states)); });
  };
  const auto read_factors = [&](JsonValue value) {
    value.each_item([&](JsonValue change) { changed_.push_back(apply_factor(change, states)); });
  };
  const auto read_faults = [&](JsonValue value) {
    faults_.reserve(value.count_items());
    value.each_item([&](JsonValue it) {
      faults_.push_back(text_of_node_from<RecordedFault, &RecordedFault::message>(
          it, states.size(), "a fault is not [index, message]"));
    });
  };
  const auto read_reasons = [&](JsonValue value) {
    value.each_item([&](JsonValue it) {
      reasons_.push_back(text_of_node_from<RecordedReason, &RecordedReason::text>(
          it, states.size(), "a reason is not [index, text]"));
    });
  };
  const auto read_answers = [&](JsonValue value) {
    value.each_item([&](JsonValue it) { answers_.push_back(answer_from(it, states.size())); });
  };
  const auto read_heard = [&](JsonValue value) {
    value.each_item([&](JsonValue it) { heard_.push_back(heard_from(it, states.size())); });
  };
  const auto read_succeeded = [&](JsonValue value) {
    constexpr char kNone[] = "'succeeded' is not a list of indices";
    succeeded_.reserve(value.count_items());
    value.each_item(
        [&](JsonValue it) { succeeded_.push_back(node_from(it, states.size(), kNone)); });
  };
  const MostWithin most = most_within(states.size());
  const auto read_moments = [&](JsonValue value) {
    value.each_item([&](JsonValue it) {
      if (moments_.size() == most.moments) {
        throw JsonError(fmt::format("more than {} moments", most.moments));
      }
      moments_.push_back(moment_from(it, states.size(), moment_changes_));
    });
  };
  const auto read_leaf_progress = [&](JsonValue value) {
    value.each_item([&](JsonValue it) {
      if (leaf_progress_.size() == most.progress) {
        throw JsonError("more leaf_progress than a tick has");
      }
      leaf_progress_.push_back(leaf_progress_from(it, states.size()));
    });
  };
  const auto read_more = [&](JsonValue value) {
    value.each_item([&](JsonValue it) { totals_.push_back(totals_from(it, states.size())); });
  };
  const auto read_entries = [&](std::vector<RecordedEntry>& entries) {
    return [&](JsonValue value) {
      value.each_item([&](JsonValue it) {
        if (entries.size() == keys_) throw JsonError("an entry is given twice");
        entries.push_back(entry_from(it, keys_));
      });
    };
  };
  const auto read_set = [&](JsonValue value) {
    value.each_item([&](JsonValue it) {
      if (set_.size() == keys_) throw JsonError("an entry is given twice");
      set_.push_back(key_from(it, keys_, "'set' is not a list of indices"));
    });
  };
  const auto read_whole = [&](JsonValue value) {
    is_whole = true;
    read_entries(whole_)(value);
  };
  json_.read(line, [&](JsonObject object) {
    object.read(
        {{lines::kTick["tick"], [&](JsonValue value) { tick = value.whole(); }, kMayLack},
         {lines::kTick["time_s"], [&](JsonValue value) { into_seconds(time.emplace())(value); },
          kMayLack},
         {lines::kTick["nodes"], read_nodes, kMayLack},
         {lines::kTick["limits"], read_limits, kMayLack},
         {lines::kTick["rounds"], read_rounds, kMayLack},
         {lines::kTick["factors"], read_factors, kMayLack},
         {lines::kTick["succeeded"], read_succeeded, kMayLack},
         {lines::kTick["moments"], read_moments, kMayLack},
         {lines::kTick["leaf_progress"], read_leaf_progress, kMayLack},
         {lines::kTick["more"], read_more, kMayLack},
         {lines::kTick["reasons"], read_reasons, kMayLack},
         {lines::kTick["answers"], read_answers, kMayLack},
         {lines::kTick["heard"], read_heard, kMayLack},
         {lines::kTick["faults"], read_faults, kMayLack},
         {lines::kTick["entries"], read_entries(entries_), kMayLack},
         {lines::kTick["set"], read_set, kMayLack},
         {lines::kTick["given"], read_entries(given_), kMayLack},
         {lines::kTick["whole"], read_whole, kMayLack},
         {lines::kTick["logs"], into_logs(logs_), kMayLack},
         {lines::kLostLine["lost"], [&](JsonValue value) { gap = gap_from(value.object()); },
          kMayLack},
         {lines::kContinuedLine["continued"],
          [&](JsonValue value) {
            value.object().read({{lines::kContinued["ticks"], into(part_end.emplace().ticks)}});
          },
          kMayLack},
         {lines::kEndLine["end"], [&](JsonValue value) { end = end_from(value.object()); },
          kMayLack}});
  });
  const bool is_tick = tick || time || has_nodes;
  if (is_tick + gap.has_value() + part_end.has_value() + end.has_value() > 1) {
    throw JsonError("a line of two kinds");
  }
  if (end) return *std::move(end);
  if (gap) return *gap;
  if (part_end) return *part_end;
  if (!tick) throw JsonError("'tick' is missing");
  if (!time) throw JsonError("'time_s' is missing");
  if (!has_nodes) throw JsonError("'nodes' is missing");
  RecordedTick result{.tick = *tick,
                      .time = *time,
                      .nodes = states,
                      .changed = changed_,
                      .succeeded = succeeded_,
                      .moments = moments(states),
                      .reasons = reasons_,
                      .answers = answers_,
                      .heard = heard_,
                      .faults = faults_,
                      .entries = entries_,
                      .set = set_,
                      .given = given_,
                      .logs = logs_};
  if (is_whole) result.whole = whole_;
  return result;
}

std::optional<std::uint64_t> RecordingJson::tick_of(std::string_view line) {
  constexpr std::string_view kBegin = "{\"tick\":";
  static_assert(kBegin.substr(2, 4) == lines::kTick["tick"]);
  if (!line.starts_with(kBegin)) return std::nullopt;
  std::uint64_t tick = 0;
  const char* const digits = line.data() + kBegin.size();
  const auto end = std::from_chars(digits, line.data() + line.size(), tick);
  return end.ec == std::errc() && end.ptr != digits ? std::optional(tick) : std::nullopt;
}

bool RecordingJson::is_end(std::string_view line) {
  constexpr std::string_view kBegin = "{\"end\":";
  static_assert(kBegin.substr(2, 3) == lines::kEndLine["end"]);
  return line.starts_with(kBegin);
}

bool RecordingJson::is_part_end(std::string_view line) {
  constexpr std::string_view kBegin = "{\"continued\":";
  static_assert(kBegin.substr(2, 9) == lines::kContinuedLine["continued"]);
  return line.starts_with(kBegin);
}

// Within a text, a quote would have a backslash before it.
bool RecordingJson::may_be_whole(std::string_view line) {
  constexpr std::string_view kKey = ",\"whole\":[";
  static_assert(kKey.substr(2, 5) == lines::kTick["whole"]);
  return line.find(kKey) != std::string_view::npos;
}

}  // namespace lockstep::host

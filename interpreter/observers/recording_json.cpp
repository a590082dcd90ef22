#include "observers/recording_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_set>

#include "core/utf8.h"

namespace lockstep {
namespace {

using Json = nlohmann::json;

const Json& member(const Json& object, const char* key) {
  if (!object.is_object()) throw BadLine("expected a JSON object");
  const auto found = object.find(key);
  if (found == object.end()) throw BadLine(fmt::format("'{}' is missing", key));
  return *found;
}

template <class T>
T member_as(const Json& object, const char* key, const char* expected) {
  try {
    return member(object, key).get<T>();
  } catch (const Json::exception&) {
    throw BadLine(fmt::format("'{}' is not {}", key, expected));
  }
}

std::string text(const Json& object, const char* key) {
  return member_as<std::string>(object, key, "a string");
}

double number(const Json& object, const char* key) {
  return member_as<double>(object, key, "a number");
}

// What fits into nanoseconds.
double seconds(const Json& object, const char* key) {
  constexpr double kMost = 9e9;
  const double value = number(object, key);
  if (value >= 0 && value <= kMost) return value;
  throw BadLine(fmt::format("'{}' is not a time in seconds", key));
}

// 0 is that of no clock. The rest is more than any can do, and its period fits into nanoseconds.
double rate(const Json& object, const char* key) {
  constexpr double kLeast = 1e-6, kMost = 1e9;
  const double value = number(object, key);
  if (value == 0 || (value >= kLeast && value <= kMost)) return value;
  throw BadLine(fmt::format("'{}' is not a number of ticks per second", key));
}

std::uint64_t whole(const Json& object, const char* key) {
  const Json& value = member(object, key);
  if (!value.is_number_unsigned()) throw BadLine(fmt::format("'{}' is not a whole number", key));
  return value.get<std::uint64_t>();
}

const Json& list(const Json& object, const char* key) {
  const Json& value = member(object, key);
  if (!value.is_array()) throw BadLine(fmt::format("'{}' is not a list", key));
  return value;
}

RecordedNode node_from(const Json& json, std::size_t index) {
  if (whole(json, "index") != index) throw BadLine(fmt::format("node {} is missing", index));
  RecordedNode node{.path = text(json, "path"),
                    .kind = text(json, "kind"),
                    .name = text(json, "name"),
                    .parent = {},
                    .barriers = {}};
  if (!member(json, "parent").is_null()) {
    const std::uint64_t parent = whole(json, "parent");
    if (parent >= index) throw BadLine(fmt::format("parent of node {} comes after it", index));
    node.parent = static_cast<NodeIndex>(parent);
  }
  const auto is_progress = [](double value) { return value >= 0 && value <= 1; };
  if (json.contains("barriers")) {
    node.synchronization = Synchronization::Absolute;
    node.barriers = member_as<std::vector<double>>(json, "barriers", "a list of numbers");
    if (!std::ranges::all_of(node.barriers, is_progress)) {
      throw BadLine(fmt::format("a barrier of node {} is not in [0, 1]", index));
    }
  } else if (json.contains("delta")) {
    node.synchronization = Synchronization::Relative;
    node.delta = number(json, "delta");
    if (!is_progress(node.delta)) {
      throw BadLine(fmt::format("the delta of node {} is not in [0, 1]", index));
    }
  }
  return node;
}

// The nodes stand in pre-order: a node's parent is the one before it, or one of that one's parents.
void check_order(std::span<const RecordedNode> nodes) {
  std::vector<NodeIndex> open;
  for (NodeIndex node = 0; node < nodes.size(); ++node) {
    const auto parent = nodes[node].parent;
    while (!open.empty() && parent && open.back() != *parent) open.pop_back();
    if (node > 0 && (!parent || open.empty()))
      throw BadLine(fmt::format("node {} is not in pre-order", node));
    open.push_back(node);
  }
}

// A path is what a node is known by.
void check_paths(std::span<const RecordedNode> nodes) {
  constexpr std::size_t kShown = 200;  // bytes
  std::unordered_set<std::string_view> paths;
  paths.reserve(nodes.size());
  for (const RecordedNode& node : nodes) {
    if (!paths.insert(node.path).second)
      throw BadLine(fmt::format("two nodes have the path '{}'", utf8_front(node.path, kShown)));
  }
}

Status status_from(const Json& json) {
  constexpr std::array kAll = {Status::Idle, Status::Running, Status::Success, Status::Failure};
  const auto found = std::find_if(kAll.begin(), kAll.end(), [&](Status status) {
    return json.is_string() && json.get_ref<const std::string&>() == to_string(status);
  });
  if (found != kAll.end()) return *found;
  throw BadLine(fmt::format("no status {}, expected idle, running, success or failure",
                            json.dump(-1, ' ', false, Json::error_handler_t::replace)));
}

bool flag_from(const Json& json) {
  if (json == 0) return false;
  if (json == 1) return true;
  throw BadLine("a node's change has a flag that is neither 0 nor 1");
}

double progress_from(const Json& json) {
  const double progress = json.is_number() ? json.get<double>() : -1.0;
  if (progress >= 0.0 && progress <= 1.0) return progress;
  throw BadLine("a node's change has a progress that is not in [0, 1]");
}

std::uint64_t index_from(const Json& json, std::size_t nodes) {
  const auto index = json.get<std::uint64_t>();
  if (index < nodes) return index;
  throw BadLine(fmt::format("no node {}, expected 0 to {}", index, nodes - 1));
}

void apply(const Json& change, std::vector<RecordedState>& states) {
  constexpr std::size_t kFields = 5;
  if (!change.is_array() || change.size() != kFields || !change[0].is_number_unsigned()) {
    throw BadLine("a node's change is not [index, status, progress, ticked, held]");
  }
  states[index_from(change[0], states.size())] = {.status = status_from(change[1]),
                                                  .progress = progress_from(change[2]),
                                                  .ticked = flag_from(change[3]),
                                                  .held = flag_from(change[4])};
}

std::vector<RecordedFault> faults_from(const Json& list, std::size_t nodes) {
  std::vector<RecordedFault> faults;
  for (const Json& fault : list) {
    if (!fault.is_array() || fault.size() != 2 || !fault[0].is_number_unsigned() ||
        !fault[1].is_string()) {
      throw BadLine("a fault is not [index, message]");
    }
    faults.push_back({static_cast<NodeIndex>(index_from(fault[0], nodes)), fault[1]});
  }
  return faults;
}

std::vector<std::string> notes_from(const Json& list) {
  std::vector<std::string> notes;
  for (const Json& note : list) {
    if (!note.is_string()) throw BadLine("a note is not a string");
    notes.push_back(note);
  }
  return notes;
}

std::vector<NodeIndex> succeeded_from(const Json& list, std::size_t nodes) {
  std::vector<NodeIndex> succeeded;
  for (const Json& node : list) {
    if (!node.is_number_unsigned()) throw BadLine("'succeeded' is not a list of indices");
    succeeded.push_back(static_cast<NodeIndex>(index_from(node, nodes)));
  }
  return succeeded;
}

}  // namespace

RecordingHeader header_from(const Json& line) {
  if (!line.is_object() || !line.contains("lockstep_recording")) {
    throw BadLine("not a recording: the first line has no 'lockstep_recording'");
  }
  const std::uint64_t version = whole(line, "lockstep_recording");
  if (version != kRecordingVersion) {
    throw BadLine(fmt::format("recording of version {}, expected {}", version, kRecordingVersion));
  }
  RecordingHeader header{.tree = text(line, "tree"),
                         .file = text(line, "file"),
                         .version = text(line, "version"),
                         .rate_hz = rate(line, "rate_hz"),
                         .clock = text(line, "clock"),
                         .seed = whole(line, "seed"),
                         .arguments = {},
                         .nodes = {}};
  const Json& arguments = member(line, "arguments");
  if (!arguments.is_object()) throw BadLine("'arguments' is not a JSON object");
  for (const auto& [name, value] : arguments.items()) {
    if (!value.is_string()) throw BadLine(fmt::format("argument '{}' is not a string", name));
    header.arguments[name] = value.get<std::string>();
  }
  for (const Json& node : list(line, "nodes")) {
    header.nodes.push_back(node_from(node, header.nodes.size()));
  }
  if (header.nodes.empty()) throw BadLine("'nodes' is empty");
  check_order(header.nodes);
  check_paths(header.nodes);
  return header;
}

RecordedEnd end_from(const Json& line) {
  const Json& json = member(line, "end");
  RecordedEnd end{.result = text(json, "result"),
                  .reason = text(json, "reason"),
                  .fault = {},
                  .signal = {},
                  .ticks = whole(json, "ticks"),
                  .time = seconds(json, "time_s"),
                  .overruns = whole(json, "overruns"),
                  .skipped = whole(json, "skipped"),
                  .lost = json.contains("lost") ? whole(json, "lost") : 0};
  if (json.contains("fault")) end.fault = text(json, "fault");
  if (json.contains("notes")) end.notes = notes_from(list(json, "notes"));
  if (json.contains("signal")) end.signal = static_cast<std::int64_t>(whole(json, "signal"));
  return end;
}

RecordedGap gap_from(const Json& line) {
  const Json& json = member(line, "lost");
  const RecordedGap gap{.ticks = whole(json, "ticks"), .from = whole(json, "from")};
  if (gap.ticks > 0 && gap.ticks - 1 <= UINT64_MAX - gap.from) return gap;
  throw BadLine(fmt::format("no {} ticks can be lost from tick {} on", gap.ticks, gap.from));
}

RecordedTick tick_from(const Json& line, std::vector<RecordedState>& states) {
  RecordedTick tick{.tick = whole(line, "tick"), .time = seconds(line, "time_s"), .nodes = {}};
  for (const Json& change : list(line, "nodes")) apply(change, states);
  tick.nodes = states;
  if (line.contains("succeeded")) {
    tick.succeeded = succeeded_from(list(line, "succeeded"), states.size());
  }
  if (line.contains("faults")) tick.faults = faults_from(list(line, "faults"), states.size());
  return tick;
}

}  // namespace lockstep

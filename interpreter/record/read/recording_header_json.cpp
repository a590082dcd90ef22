// The first line of a recording.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <unordered_set>

#include "base/core/language.h"
#include "base/core/resource_set.h"
#include "base/core/wording.h"
#include "record/lines.h"
#include "record/read/recording_json.h"
#include "run/shape_of.h"

namespace lockstep::host {
namespace {

// 0 is that of no clock. The rest is more than any can do, and its period fits into nanoseconds.
double rate_from(JsonValue value) {
  constexpr double kLeast = 1e-6, kMost = 1e9;
  const double rate = value.number();
  if (rate == 0 || (rate >= kLeast && rate <= kMost)) return rate;
  throw JsonError("'rate_hz' is not a number of ticks per second");
}

bool is_progress(double value) {
  return value >= 0 && value <= 1;
}

NodeIndex parent_from(JsonValue value, std::size_t index) {
  const std::uint64_t parent = value.whole();
  if (parent < index) return static_cast<NodeIndex>(parent);
  throw JsonError(fmt::format("parent of node {} comes after it", index));
}

std::vector<double> barriers_from(JsonValue value, std::size_t index) {
  std::vector<double> barriers;
  barriers.reserve(value.count_items());
  value.each_item([&](JsonValue item) { barriers.push_back(item.number()); });
  if (std::ranges::all_of(barriers, is_progress)) return barriers;
  throw JsonError(fmt::format("a barrier of node {} is not in [0, 1]", index));
}

double delta_from(JsonValue value, std::size_t index) {
  const double delta = value.number();
  if (is_progress(delta)) return delta;
  throw JsonError(fmt::format("the delta of node {} is not in [0, 1]", index));
}

std::vector<NodeIndex> members_from(JsonValue value, std::size_t index) {
  std::vector<NodeIndex> members;
  members.reserve(value.count_items());
  value.each_item([&](JsonValue item) {
    const std::uint64_t member = item.whole();
    if (member >= index || (!members.empty() && member <= members.back())) {
      throw JsonError(fmt::format("the members of node {} are not nodes before it, rising", index));
    }
    members.push_back(static_cast<NodeIndex>(member));
  });
  return members;
}

std::vector<std::string> resources_from(JsonValue value, std::size_t index) {
  std::vector<std::string> resources;
  value.each_item([&](JsonValue item) {
    std::string_view name;
    if (!item.get(name) || name.empty() || resources.size() == kMaxResources) {
      throw JsonError(
          fmt::format("the resources of node {} are not up to {} names", index, kMaxResources));
    }
    resources.emplace_back(name);
  });
  return resources;
}

std::vector<std::string> texts_from(JsonValue value, std::size_t index) {
  std::vector<std::string> texts;
  value.each_item([&](JsonValue item) {
    std::string_view text;
    if (!item.get(text))
      throw JsonError(fmt::format("'reads' of node {} is no list of texts", index));
    texts.emplace_back(text);
  });
  return texts;
}

bool is_ignore(JsonValue value, std::size_t index) {
  std::string_view text;
  if (value.get(text) && (text == "ignore" || text == "wait")) return text == "ignore";
  throw JsonError(fmt::format("'idle' of node {} is neither 'wait' nor 'ignore'", index));
}

bool is_yes(JsonValue value, std::string_view key, std::size_t index,
            std::string_view what = "node") {
  bool yes = false;
  if (value.get(yes) && yes) return true;
  throw JsonError(fmt::format("'{}' of {} {} is not true", key, what, index));
}

// A recording names kinds, and does not say in which language: where one has a fact, it counts.
void add_facts_of_kind(ShapeNode& node) {
  for (const LanguageRules* rules : languages()) {
    for (const NodeType* it : built_in_types(*rules)) {
      if (it->id == node.kind) add_facts(*it, node);
    }
  }
}

using Texts = decltype(RecordingHeader::arguments);

Texts named_texts(JsonValue value, std::string_view what) {
  Texts texts;
  value.object().each_field([&](std::string_view name, JsonValue item) {
    std::string_view text;
    if (!item.get(text)) throw JsonError(fmt::format("{} '{}' is not a string", what, brief(name)));
    if (!texts.emplace(name, text).second)
      throw JsonError(fmt::format("{} '{}' is given twice", what, brief(name)));
  });
  return texts;
}

ShapeNode node_from(JsonObject object, std::size_t index) {
  ShapeNode node;
  std::uint64_t place = 0;
  bool is_absolute = false, is_relative = false;
  NodeQuestion question;
  object.read(
      {{lines::kHeaderNode["index"], into(place)},
       {lines::kHeaderNode["path"], into(node.path)},
       {lines::kHeaderNode["kind"], into(node.kind)},
       {lines::kHeaderNode["name"], into(node.name)},
       {lines::kHeaderNode["parent"],
        [&](JsonValue value) {
          if (!value.is_null()) node.parent = parent_from(value, index);
        }},
       {lines::kHeaderNode["barriers"],
        [&](JsonValue value) {
          is_absolute = true;
          if (!value.is_null()) node.barriers = barriers_from(value, index);
        },
        kMayLack},
       {lines::kHeaderNode["delta"],
        [&](JsonValue value) {
          is_relative = true;
          if (!value.is_null()) node.delta = delta_from(value, index);
        },
        kMayLack},
       {lines::kHeaderNode["idle"],
        [&](JsonValue value) { node.ignores_idle = is_ignore(value, index); }, kMayLack},
       {lines::kHeaderNode["resources"],
        [&](JsonValue value) { node.resources = resources_from(value, index); }, kMayLack},
       {lines::kHeaderNode["members"],
        [&](JsonValue value) { node.members = members_from(value, index); }, kMayLack},
       {lines::kHeaderNode["pace"],
        [&](JsonValue value) { node.paces = is_yes(value, "pace", index); }, kMayLack},
       {lines::kHeaderNode["condition"], into(node.condition), kMayLack},
       {lines::kHeaderNode["reads"],
        [&](JsonValue value) { node.reads = texts_from(value, index); }, kMayLack},
       {lines::kHeaderNode["ports"],
        [&](JsonValue value) {
          node.ports = std::make_shared<const Texts>(named_texts(value, "port"));
        },
        kMayLack},
       {lines::kHeaderNode["options"],
        [&](JsonValue value) { question.options = texts_from(value, index); }, kMayLack},
       {lines::kHeaderNode["default"], into(question.fallback), kMayLack},
       {lines::kHeaderNode["timeout_s"],
        [&](JsonValue value) { into(question.timeout.emplace())(value); }, kMayLack},
       {lines::kHeaderNode["severity"], into(question.severity), kMayLack},
       {lines::kHeaderNode["guard"],
        [&](JsonValue value) { node.is_guard = is_yes(value, "guard", index); }, kMayLack}});
  if (place != index) throw JsonError(fmt::format("node {} is missing", index));
  if (is_absolute && is_relative)
    throw JsonError(fmt::format("node {} has both barriers and delta", index));
  if (!question.options.empty()) {
    node.question = std::make_shared<const NodeQuestion>(std::move(question));
  }
  if (is_absolute) node.synchronization = Synchronization::Absolute;
  if (is_relative) node.synchronization = Synchronization::Relative;
  if (!node.resources.empty()) node.synchronization = Synchronization::Resources;
  add_facts_of_kind(node);
  return node;
}

std::vector<ShapeNode> nodes_from(JsonValue value) {
  std::vector<ShapeNode> nodes;
  nodes.reserve(value.count_items());
  value.each_item([&](JsonValue item) { nodes.push_back(node_from(item.object(), nodes.size())); });
  return nodes;
}

std::vector<ShapeEntry> keys_from(JsonValue value) {
  std::vector<ShapeEntry> keys;
  keys.reserve(value.count_items());
  value.each_item([&](JsonValue item) {
    ShapeEntry& it = keys.emplace_back();
    item.object().read({{lines::kHeaderEntry["key"], into(it.key)},
                        {lines::kHeaderEntry["type"], into(it.type)},
                        {lines::kHeaderEntry["strict"],
                         [&](JsonValue strict) {
                           if (is_yes(strict, "strict", keys.size() - 1, "entry"))
                             it.typing = Typing::Strict;
                         },
                         kMayLack},
                        {lines::kHeaderEntry["writers"],
                         [&](JsonValue writers) {
                           writers.each_item([&](JsonValue writer) {
                             it.writers.push_back(static_cast<NodeIndex>(writer.whole()));
                           });
                         },
                         kMayLack}});
  });
  return keys;
}

template <class Value>
auto into_header(Value& value) {
  return into(value);
}
auto into_header(double& rate) {
  return [&rate](JsonValue value) { rate = rate_from(value); };
}
auto into_header(std::optional<double>& time) {
  return [&time](JsonValue value) {
    double seconds = 0;
    if (!value.get(seconds) || !(seconds >= 0)) throw JsonError("'resumed_after_s' is no time");
    time = seconds;
  };
}
auto into_header(Texts& texts) {
  return [&texts](JsonValue value) { texts = named_texts(value, "argument"); };
}
auto into_header(std::vector<ShapeNode>& nodes) {
  return [&nodes](JsonValue value) { nodes = nodes_from(value); };
}
auto into_header(std::vector<ShapeEntry>& keys) {
  return [&keys](JsonValue value) { keys = keys_from(value); };
}

// The nodes are in pre-order: the parent of a node is the node before it, or one of its ancestors.
// Groups, without parents, are behind them.
void check_order(std::span<const ShapeNode> nodes) {
  std::vector<NodeIndex> open;
  const auto is_group = [](const ShapeNode& node) { return !node.members.empty(); };
  while (nodes.size() > 1 && is_group(nodes.back()) && !nodes.back().parent) {
    nodes = nodes.first(nodes.size() - 1);
  }
  for (NodeIndex node = 0; node < nodes.size(); ++node) {
    if (is_group(nodes[node])) throw JsonError(fmt::format("node {} has members", node));
    const auto parent = nodes[node].parent;
    while (!open.empty() && parent && open.back() != *parent) open.pop_back();
    if (node > 0 && (!parent || open.empty()))
      throw JsonError(fmt::format("node {} is not in pre-order", node));
    open.push_back(node);
  }
}

// A path is what a node is known by.
void check_paths(std::span<const ShapeNode> nodes) {
  std::unordered_set<std::string_view> paths;
  paths.reserve(nodes.size());
  for (const ShapeNode& node : nodes) {
    if (!paths.insert(node.path).second)
      throw JsonError(fmt::format("two nodes have the path '{}'", brief(node.path)));
  }
}

void check_writers(const Shape& shape) {
  for (const ShapeEntry& entry : shape.entries) {
    const bool are_nodes = std::ranges::all_of(
        entry.writers, [&](NodeIndex writer) { return writer < shape.nodes.size(); });
    if (!are_nodes) {
      throw JsonError(fmt::format("a writer of entry '{}' is not a node", brief(entry.key)));
    }
  }
}

// Before all else: of another version, anything else may be different.
void check_version(JsonReader& json, std::string& line) {
  std::optional<std::uint64_t> version;
  json.read(line, [&](JsonObject object) {
    object.read({{lines::kHeader["lockstep_recording"],
                  [&](JsonValue value) { version = value.whole(); }, kMayLack}});
  });
  if (!version) throw JsonError("not a recording: the first line has no 'lockstep_recording'");
  if (*version != kRecordingVersion) {
    throw JsonError(
        fmt::format("recording of version {}, expected {}", *version, kRecordingVersion));
  }
}

}  // namespace

RecordingHeader RecordingJson::header(std::string& line) {
  check_version(json_, line);
  RecordingHeader header;
  std::vector<JsonField> fields;
  lines::each_member(lines::kHeader, header, [&](const lines::Field& field, auto& value) {
    fields.push_back({field.key, into_header(value), field.has == lines::kMaybe});
  });
  json_.read(line, [&](JsonObject object) {
    object.read(fields);
    keys_ = header.entries.size();
    users_ = resource_users(header);
  });
  if (header.nodes.empty()) throw JsonError("'nodes' is empty");
  check_order(header.nodes);
  check_paths(header.nodes);
  check_writers(header);
  complete(header);
  return header;
}

}  // namespace lockstep::host

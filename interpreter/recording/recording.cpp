#include "recording/recording.h"

#include "core/json.h"

namespace lockstep {
namespace {

Json json_of(const RecordedNode& node, std::size_t index) {
  Json json = {{"index", index}, {"path", node.path}, {"kind", node.kind}, {"name", node.name}};
  json["parent"] = node.parent;
  if (node.synchronization == Synchronization::Absolute) {
    json["barriers"] = node.barriers;
  } else if (node.synchronization == Synchronization::Relative) {
    json["delta"] = node.delta;
  }
  return json;
}

Json json_of(const RecordedKey& entry) {
  return {{"key", entry.key}, {"type", entry.type}};
}

Json json_of(const RecordedLog& log) {
  return Json::array({log.who, log.level, log.text});
}

template <class Item>
Json list_of(const std::vector<Item>& items) {
  Json list = Json::array();
  for (const Item& item : items) list.push_back(json_of(item));
  return list;
}

}  // namespace

std::vector<RecordedNode> describe(const Tree& tree) {
  std::vector<RecordedNode> nodes(tree.nodes.size());
  for (NodeIndex index = 0; index < nodes.size(); ++index) {
    RecordedNode& node = nodes[index];
    const NodeLabel& label = tree.labels[index];
    node.path = tree.path(index);
    node.kind = label.type->id;
    node.name = label.name;
    if (label.parent != index) node.parent = label.parent;
    node.synchronization = synchronization(tree.nodes[index]);
    if (const auto list = barriers(tree, index)) node.barriers.emplace(list->begin(), list->end());
    node.delta = delta(tree, index);
  }
  return nodes;
}

Nanoseconds period_of(const RecordingHeader& header) {
  return header.rate_hz > 0 ? from_seconds(1 / header.rate_hz) : Nanoseconds(0);
}

std::string shown_value(const RecordedEntry& entry) {
  return entry.value.value_or("(too long to be recorded)");
}

std::string to_json(const RecordingHeader& header) {
  Json json = {{"lockstep_recording", kRecordingVersion},
               {"tree", header.tree},
               {"file", header.file},
               {"version", header.version},
               {"rate_hz", header.rate_hz},
               {"clock", header.clock},
               {"seed", header.seed}};
  json["arguments"] = Json::object();
  for (const auto& [name, value] : header.arguments) json["arguments"][name] = value;
  json["nodes"] = Json::array();
  for (std::size_t index = 0; index < header.nodes.size(); ++index) {
    json["nodes"].push_back(json_of(header.nodes[index], index));
  }
  if (!header.entries.empty()) json["entries"] = list_of(header.entries);
  return json.text();
}

std::string to_json(const RecordedEnd& end) {
  Json json = {{"result", end.result}, {"reason", end.reason}};
  if (!end.fault.empty()) json["fault"] = end.fault;
  if (end.signal) json["signal"] = *end.signal;
  json["ticks"] = end.ticks;
  json["time_s"] = end.time;
  json["overruns"] = end.overruns;
  json["skipped"] = end.skipped;
  if (end.lost > 0) json["lost"] = end.lost;
  if (!end.notes.empty()) json["notes"] = end.notes;
  if (!end.logs.empty()) json["logs"] = list_of(end.logs);
  return Json{{"end", std::move(json)}}.text();
}

}  // namespace lockstep

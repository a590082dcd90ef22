#include <fmt/format.h>

#include "base/core/diagnostics.h"
#include "base/json/json.h"
#include "describe/tree_diff.h"

namespace lockstep::host {
namespace {

Json json_of(const SourceLocation& place) {
  if (place.line == 0) return {};
  return {{"file", place.file}, {"line", place.line}, {"column", place.column}};
}

Json json_of(const TreeDiff& diff, const TreeChange& change) {
  Json json = Json::object();
  json["change"] = to_string(change.kind);
  const auto add_node = [&](const char* name, const MatchedTree& tree, std::uint32_t node,
                            const SourceLocation& place) {
    if (node == kNoNode) return;
    json.add(name, {{"path", tree.paths[node]},
                    {"kind", tree.node(node).type->id},
                    {"place", json_of(place)}});
  };
  add_node("old", diff.trees[0], change.old_node, change.old_place);
  add_node("new", diff.trees[1], change.new_node, change.new_place);
  if (!change.values.empty()) {
    Json values = Json::array();
    const auto value = [](const std::string& it) { return it.empty() ? Json() : Json(it); };
    for (const ValueChange& it : change.values) {
      values.push_back({{"name", it.name.empty() ? Json() : Json(it.name)},
                        {"old", value(it.old_value)},
                        {"new", value(it.new_value)}});
    }
    json["values"] = values;
  }
  if (change.old_child != 0) {
    json["child"] = {{"old", change.old_child}, {"new", change.new_child}};
  }
  const bool is_there = change.kind == TreeChangeKind::New || change.kind == TreeChangeKind::Gone;
  if (is_there) json["below"] = change.below;
  if (change.around != kNoNode) json["around"] = diff.trees[0].paths[change.around];
  if (!change.also.empty()) json["also"] = change.also;
  return json;
}

}  // namespace

std::string diff_as_json(const TreeDiff& diff) {
  Json changes = Json::array(), properties = Json::array();
  for (const TreeChange& it : diff.changes) changes.push_back(json_of(diff, it));
  for (const PropertyChange& it : diff.properties) {
    properties.push_back({{"name", it.name},
                          {"old", it.old_text.empty() ? Json() : Json(it.old_text)},
                          {"new", it.new_text.empty() ? Json() : Json(it.new_text)},
                          {"old_place", json_of(it.old_place)},
                          {"new_place", json_of(it.new_place)}});
  }
  const Json json{
      {"same", diff.same()},
      {"old", diff.sides[0].name},
      {"new", diff.sides[1].name},
      {"tree", {{"old", diff.sides[0].definition->id}, {"new", diff.sides[1].definition->id}}},
      {"changes", changes},
      {"properties", properties}};
  return json.text() + '\n';
}

std::string tree_as_change(const std::string& id, TreeChangeKind kind, const std::string& file,
                           bool as_json) {
  if (!as_json) {
    return fmt::format("{:<8} {}  the tree  {}\n", to_string(kind), printable(id), printable(file));
  }
  return Json{{"same", false}, {"tree", id}, {"change", to_string(kind)}, {"file", file}}.text() +
         '\n';
}

}  // namespace lockstep::host

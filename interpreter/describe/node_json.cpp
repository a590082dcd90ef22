#include <cmath>

#include "base/core/parameter_value.h"
#include "base/json/json.h"
#include "describe/node_reference.h"
#include "leaves/declared.h"

namespace lockstep::host {
namespace {

Json range_json(const Range& range) {
  if (!std::isfinite(range.min) && !std::isfinite(range.max)) return nullptr;
  Json json{{"min", nullptr}, {"max", nullptr}, {"min_excluded", range.min_excluded}};
  if (std::isfinite(range.min)) json["min"] = range.min;
  if (std::isfinite(range.max)) json["max"] = range.max;
  return json;
}

Json parameter_json(const Parameter& parameter) {
  const bool is_code = parameter.is_script && !parameter.is_template;
  Json json{{"name", parameter.name},
            {"type", is_code ? "script" : type_name(parameter.type, parameter.object)},
            {"direction", to_string(parameter.direction)},
            {"default", nullptr},
            {"required", parameter.required},
            {"unit", parameter.unit},
            {"range", range_json(parameter.range)},
            {"choices", Json::array({parameter.choices.begin(), parameter.choices.end()})},
            {"blackboard", !parameter.constant && !is_code},
            {"doc", parameter.doc}};
  if (parameter.default_text) json["default"] = *parameter.default_text;
  return json;
}

Json children_json(const NodeType& type) {
  const bool none = type.category == NodeCategory::SubTree;
  Json json{{"min", none ? 0 : type.arity.min}, {"max", nullptr}};
  if (none) {
    json["max"] = 0;
  } else if (type.arity.max != Arity{}.max) {
    json["max"] = type.arity.max;
  }
  return json;
}

}  // namespace

std::string nodes_as_json(NodeTypes types) {
  auto all = Json::array();
  for (const NodeType* type : types) {
    auto parameters = Json::array();
    for (const Parameter& it : type->parameters) parameters.push_back(parameter_json(it));
    auto behavior = Json::object();
    for (const Statement& it : declared_behavior(*type)) {
      behavior[std::string(it.word)] = it.value;
    }
    all.push_back({{"id", type->id},
                   {"category", to_string(type->category)},
                   {"plugin", type->plugin},
                   {"doc", type->doc},
                   {"children", children_json(*type)},
                   {"has_progress", type->has_progress},
                   {"real_time", type->real_time},
                   {"behavior", std::move(behavior)},
                   {"more_parameters", type->more_parameters},
                   {"parameters", std::move(parameters)}});
  }
  return all.printable(2) + "\n";
}

}  // namespace lockstep::host

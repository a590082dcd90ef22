// Substitution rules: which nodes of a tree are replaced when it is made, and by what.
#pragma once

#include <lockstep/duration.h>

#include <chrono>
#include <memory>
#include <string>
#include <unordered_map>

#include "behaviortree_cpp/lockstep/plain_json.h"
#include "behaviortree_cpp/lockstep/substitution_rule.h"
#include "behaviortree_cpp/utils/wildcards.hpp"

namespace BT::lockstep_detail {

inline const SubstitutionRule* rule_for(const SubstitutionRules& rules, const std::string& name,
                                        const std::string& id, const std::string& path) {
  for (const auto& [filter, rule] : rules) {
    if (filter == name || filter == id || wildcards_match(path, filter)) return &rule;
  }
  return nullptr;
}

// The TestNode of a rule that names no registered node.
inline std::shared_ptr<TestNodeConfig> test_of(const SubstitutionRule& rule) {
  if (const auto* const shared = std::get_if<std::shared_ptr<TestNodeConfig>>(&rule)) {
    return *shared;
  }
  const auto* const config = std::get_if<TestNodeConfig>(&rule);
  return config == nullptr ? nullptr : std::make_shared<TestNodeConfig>(*config);
}

inline TestNodeConfig test_from_json(const std::string& name, const PlainJson& json) {
  TestNodeConfig config;
  const std::string status = json.text("return_status");
  config.return_status_script = json.text("return_status_script");
  if (status.empty() && config.return_status_script.empty()) {
    throw RuntimeError("TestNodeConfigs: '", name,
                       "' needs return_status, such as \"SUCCESS\", or return_status_script");
  }
  if (!status.empty()) config.return_status = convertFromString<NodeStatus>(status);
  config.success_script = json.text("success_script");
  config.failure_script = json.text("failure_script");
  config.post_script = json.text("post_script");
  const std::chrono::duration<double, std::milli> delay(json.number("async_delay"));
  config.async_delay =
      std::chrono::duration_cast<std::chrono::milliseconds>(::lockstep::bounded(delay));
  return config;
}

// {"TestNodeConfigs": {name: config}, "SubstitutionRules": {filter: name or ID}}
inline SubstitutionRules rules_from_json(const std::string& text) {
  const PlainJson json = PlainJson::read(text);
  std::unordered_map<std::string, TestNodeConfig> configs;
  if (const PlainJson* const listed = json.find("TestNodeConfigs")) {
    for (const auto& [name, it] : listed->members) configs[name] = test_from_json(name, it);
  }
  const PlainJson* const listed = json.find("SubstitutionRules");
  if (listed == nullptr) throw RuntimeError("the JSON has no object SubstitutionRules");
  SubstitutionRules rules;
  for (const auto& [filter, it] : listed->members) {
    const auto config = configs.find(it.value);
    if (it.kind != PlainJson::Kind::kText) {
      throw RuntimeError("SubstitutionRules: '", filter, "' needs a name, in quotes");
    }
    if (config == configs.end()) {
      rules[filter] = it.value;
    } else {
      rules[filter] = config->second;
    }
  }
  return rules;
}

}  // namespace BT::lockstep_detail

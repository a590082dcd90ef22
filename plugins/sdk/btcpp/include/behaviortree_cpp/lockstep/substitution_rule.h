// A rule takes the place of a node: the ID of a registered one, or the configuration of a TestNode.
#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <variant>

#include "behaviortree_cpp/actions/test_node.h"

namespace BT::lockstep_detail {

using SubstitutionRule = std::variant<std::string, TestNodeConfig, std::shared_ptr<TestNodeConfig>>;
// By what they are for: the name of a node, its ID, or a pattern of its path.
using SubstitutionRules = std::unordered_map<std::string, SubstitutionRule>;

}  // namespace BT::lockstep_detail

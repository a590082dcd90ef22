// The list of node types as text, as JSON, and as Markdown for docs/nodes.md, made from the rows
// that the checker uses. Prints nothing.
#pragma once

#include <span>
#include <string>

#include "base/core/node_type.h"

namespace lockstep::host {

using NodeTypes = std::span<const NodeType* const>;

// Grouped by category, at most 100 columns wide.
std::string nodes_as_text(NodeTypes types);
// One node in full.
std::string node_as_text(const NodeType& type);
// An array of objects; docs/cli.md names the members.
std::string nodes_as_json(NodeTypes types);
std::string nodes_as_markdown(NodeTypes types);
// A document for BehaviorTree.CPP with a TreeNodesModel, as its editors read it.
std::string nodes_as_models(NodeTypes types);
// Its TreeNodesModel alone.
std::string tree_nodes_model(NodeTypes types);

// Shared by the functions above: the categories in the order of the pages, with their headings.
struct NodeGroup {
  NodeCategory category;
  std::string_view heading;
};
std::span<const NodeGroup> node_groups();

// "no children", "exactly one child", "one or more children".
std::string children_text(const NodeType& type);
// "number in s, required, from 0 to 1": everything except the name and the doc.
std::string facts_text(const Parameter& parameter);
// result="success" ticks="2..40": what its plugin says that it does; "" for nothing.
std::string behavior_text(const NodeType& type);
// About the names in NodeType::more_parameters.
inline constexpr std::string_view kMoreParameters =
    "More parameters: which ones is found out by what the element gives to the constant ones.";
// A line that shows how the node is written in a tree.
std::string usage_text(const NodeType& type);
// The attributes that are not parameters of one node, one sentence each.
struct CommonAttribute {
  std::string_view name;
  std::string_view doc;
};
std::span<const CommonAttribute> common_attributes();
// The attributes that every node has too: the scripts around its ticks, in the order of Hook.
std::span<const CommonAttribute> script_attributes();
std::span<const CommonAttribute> subtree_attributes();
// The attributes that an action of a plugin has too.
std::span<const CommonAttribute> action_attributes();
inline bool has_action_attributes(const NodeType& type) {
  return type.category == NodeCategory::Action && (type.leaf != nullptr || type.mock != nullptr);
}

}  // namespace lockstep::host

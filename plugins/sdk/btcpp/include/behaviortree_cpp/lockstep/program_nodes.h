// The nodes of a tree that a program ticks, as the library shows them. Included by program.h.
#pragma once

#include <lockstep/runtime.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "behaviortree_cpp/behavior_tree.h"
#include "behaviortree_cpp/lockstep/node_ids.h"
#include "behaviortree_cpp/lockstep/outline.h"
#include "behaviortree_cpp/lockstep/plugin_table.h"

namespace BT::lockstep_detail {

// Where a node is in a tree.
struct NodePlace {
  std::uint32_t parent = 0;  // the root is its own
  std::string name, id;
  std::string own_path;     // lockstep's
  NodeNumber number;        // the library's
  std::size_t subtree = 0;  // of the list of those
};

struct SubtreePlace {
  std::string name, path;    // "" for the main tree
  std::string entries;       // what is in front of the keys of its entries
  std::string tree_id = {};  // "": as its name
};

// All nodes, in the order of the tree.
struct NodePlaces {
  std::vector<NodePlace> nodes;
  std::vector<SubtreePlace> subtrees{1};

  // `outline`: what the documents say; null: they could not be read.
  NodePlaces(const lockstep_project* project, const Outline* outline, PluginTable& table) {
    std::vector<std::size_t> inside;  // of each node: the subtree that its children are in
    for (std::uint32_t i = 0; i < lockstep_project_node_count(project); ++i) {
      lockstep_node it{};
      it.struct_size = sizeof it;
      if (!lockstep_project_node(project, i, &it)) return;
      const std::size_t outer = it.parent == i ? 0 : inside[it.parent];
      inside.push_back(add(it, i, outer));
    }
    if (outline != nullptr) take(*outline, table);
  }

 private:
  // As lockstep has the same nodes.
  void take(const Outline& outline, PluginTable& table) {
    if (outline.nodes.size() != nodes.size() || outline.subtrees.size() != subtrees.size()) return;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const OutlineNode& from = outline.nodes[i];
      nodes[i].name = from.name;
      nodes[i].number.path = from.path;
      nodes[i].number.uid = from.uid;
      read_attributes(*from.element, from.id, table.manifest(from.id), nodes[i].number);
    }
    for (std::size_t i = 0; i < subtrees.size(); ++i) {
      subtrees[i].path = outline.subtrees[i].path;
      subtrees[i].tree_id = outline.subtrees[i].tree_id;
    }
  }
  std::size_t add(const lockstep_node& it, std::uint32_t index, std::size_t outer) {
    NodePlace node{it.parent, it.name, it.id, it.path, {}, outer};
    node.number.uid = static_cast<std::uint16_t>(index + 1);
    const std::string& prefix = subtrees[outer].path;
    node.number.path = prefix.empty() ? node.name : prefix + "/" + node.name;
    if (node.name == node.id) node.number.path += "::" + std::to_string(index + 1);
    if (node.id == "SubTree") {
      const std::string last = node.own_path.substr(node.own_path.rfind('/') + 1);
      subtrees.push_back({node.name, node.number.path, subtrees[outer].entries + last + "/"});
    }
    const bool begins = node.id == "SubTree";
    nodes.push_back(std::move(node));
    return begins ? subtrees.size() - 1 : outer;
  }
};

// The type of a node of the language, by its ID.
inline NodeType type_of_id(const std::string& id) {
  static const std::map<std::string, NodeType> types = [] {
    std::map<std::string, NodeType> all{{"SubTree", NodeType::SUBTREE}};
    for (const char* it : {"AlwaysFailure", "AlwaysSuccess", "Script", "SetBlackboard", "Sleep",
                           "UnsetBlackboard", "WasEntryUpdated"}) {
      all[it] = NodeType::ACTION;
    }
    all["ScriptCondition"] = NodeType::CONDITION;
    for (const char* it :
         {"Delay", "ForceFailure", "ForceSuccess", "Inverter", "KeepRunningUntilFailure",
          "LoopBool", "LoopDouble", "LoopInt", "LoopString", "Precondition", "Repeat",
          "RetryUntilSuccessful", "RunOnce", "SkipUnlessUpdated", "Timeout", "WaitValueUpdate"}) {
      all[it] = NodeType::DECORATOR;
    }
    for (const std::string& it : node_ids()) all.emplace(it, NodeType::CONTROL);
    return all;
  }();
  const auto found = types.find(id);
  return found == types.end() ? NodeType::ACTION : found->second;
}

}  // namespace BT::lockstep_detail

// The nodes of a tree that a program ticks, as the library shows them. Included by program.h.
#pragma once

#include <lockstep/runtime.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "behaviortree_cpp/behavior_tree.h"
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
  std::string name, path;  // "" for the main tree
  std::string entries;     // what is in front of the keys of its entries
};

// All nodes, in the order of the tree.
struct NodePlaces {
  std::vector<NodePlace> nodes;
  std::vector<SubtreePlace> subtrees{1};

  explicit NodePlaces(const lockstep_project* project) {
    std::vector<std::size_t> inside;  // of each node: the subtree that its children are in
    for (std::uint32_t i = 0; i < lockstep_project_node_count(project); ++i) {
      lockstep_node it{};
      it.struct_size = sizeof it;
      if (!lockstep_project_node(project, i, &it)) return;
      const std::size_t outer = it.parent == i ? 0 : inside[it.parent];
      inside.push_back(add(it, i, outer));
    }
  }

 private:
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

class Program;

// A node that is no object of the program: of the language, or of a plugin.
class ProgramNode final : public TreeNode {
 public:
  ProgramNode(Program& program, lockstep_run* run, std::uint32_t index, const NodePlaces& places,
              NodeType type)
      : TreeNode(places.nodes[index].name, config_of(places.nodes[index])),
        program_(program),
        run_(run),
        index_(index),
        places_(&places),
        type_(type) {
    setRegistrationID(places.nodes[index].id);
  }

  NodeType type() const override { return type_; }
  NodeStatus executeTick() override {
    throw LogicError("node '", name(), "' is ticked by its tree only: BT::Tree::tickOnce()");
  }
  Program& program() const { return program_; }
  std::uint32_t index() const { return index_; }
  const NodePlaces& places() const { return *places_; }

 private:
  static NodeConfig config_of(const NodePlace& place) {
    NodeConfig config;
    config.path = place.number.path;
    config.uid = place.number.uid;
    return config;
  }
  NodeStatus tick() override { return executeTick(); }
  // For the root this is the whole tree.
  void halt() override {
    if (index_ == 0) lockstep_run_halt(run_);
  }
  NodeStatus lockstep_shown_status() const override {
    lockstep_node_state state{};
    state.struct_size = sizeof state;
    if (!lockstep_run_node(run_, index_, &state)) return NodeStatus::IDLE;
    return static_cast<NodeStatus>(state.status);
  }
  void lockstep_forget_status() override {}

  Program& program_;
  lockstep_run* run_;
  std::uint32_t index_;
  const NodePlaces* places_;
  NodeType type_;
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

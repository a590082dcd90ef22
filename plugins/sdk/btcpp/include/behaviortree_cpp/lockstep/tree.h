// A tree that a program ticks: what BehaviorTreeFactory::createTreeFromFile returns. Included by
// bt_factory.h where all of lockstep is installed.
#pragma once

#include <lockstep/duration.h>
#include <lockstep/runtime.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "behaviortree_cpp/blackboard.h"
#include "behaviortree_cpp/tree_node.h"
#include "behaviortree_cpp/utils/wakeup_signal.hpp"
#include "behaviortree_cpp/utils/wildcards.hpp"

namespace BT {
namespace lockstep_detail {

class PluginTable;

// A program that shows its trees in Groot2 sets it before it makes one: groot2_publisher.h.
inline bool groot_is_wanted = false;

// The manifests that a tree's nodes have, as long as it lives.
class ManifestsOfTree {
 public:
  using Map = std::unordered_map<std::string, TreeNodeManifest>;
  ManifestsOfTree() = default;
  explicit ManifestsOfTree(std::shared_ptr<PluginTable> table) : table_(std::move(table)) {}

  Map::const_iterator begin() const { return map().begin(); }
  Map::const_iterator end() const { return map().end(); }
  Map::const_iterator find(const std::string& id) const { return map().find(id); }
  const TreeNodeManifest& at(const std::string& id) const { return map().at(id); }
  std::size_t count(const std::string& id) const { return map().count(id); }
  std::size_t size() const { return map().size(); }
  bool empty() const { return map().empty(); }
  operator const Map&() const { return map(); }  // NOLINT(google-explicit-constructor): it is one

 private:
  const Map& map() const;

  std::shared_ptr<PluginTable> table_;
};

}  // namespace lockstep_detail

class Tree {
 public:
  struct Subtree {
    using Ptr = std::shared_ptr<Subtree>;
    std::vector<TreeNode::Ptr> nodes;
    Blackboard::Ptr blackboard;
    std::string instance_name;  // "" of the main tree
    std::string tree_ID;
  };
  std::vector<Subtree::Ptr> subtrees;  // the main tree first
  // The manifests of all nodes that the tree may have; config().manifest points to them.
  lockstep_detail::ManifestsOfTree manifests;

  Tree() = default;
  explicit Tree(std::shared_ptr<lockstep_detail::Program> program);

  // The tree is ticked again while a node asks for it.
  NodeStatus tickOnce();
  NodeStatus tickExactlyOnce();
  NodeStatus tickWhileRunning(std::chrono::milliseconds sleep_time = std::chrono::milliseconds(10));
  void haltTree();
  // True: emitWakeUpSignal() of the tree or of a node has ended it.
  template <class Rep, class Period>
  bool sleep(std::chrono::duration<Rep, Period> duration) {
    return lockstep_sleep(
        std::chrono::duration_cast<std::chrono::microseconds>(lockstep::bounded(duration)));
  }
  // From any thread.
  void emitWakeUpSignal();
  [[nodiscard]] std::shared_ptr<WakeUpSignal> wakeUpSignal() const;
  // The board of the main tree; null: the tree is empty.
  Blackboard::Ptr rootBlackboard() const;

  // Its haltNode() halts the whole tree, its executeTick() ticks it.
  [[nodiscard]] TreeNode* rootNode() const;
  // A program's own nodes are the objects that its classes made; others have a name, a path, a type
  // and a status.
  void applyVisitor(const std::function<void(const TreeNode*)>& visitor) const;
  void applyVisitor(const std::function<void(TreeNode*)>& visitor);
  template <class Node = TreeNode>
  [[nodiscard]] std::vector<const TreeNode*> getNodesByPath(StringView pattern) const {
    std::vector<const TreeNode*> found;
    for (const auto& node : lockstep_nodes()) {
      if (dynamic_cast<const Node*>(node.get()) == nullptr) continue;
      if (wildcards_match(node->fullPath(), pattern)) found.push_back(node.get());
    }
    return found;
  }

  lockstep_detail::Program& lockstep_program() const;

 private:
  const std::vector<TreeNode::Ptr>& lockstep_nodes() const;
  bool lockstep_sleep(std::chrono::microseconds duration);

  std::shared_ptr<lockstep_detail::Program> program_;
};

// The entries of all boards of a tree, in the order of Tree::subtrees. Templates, so that only code
// that calls them opens entries (opening_mark.h).
template <class AnyTree>
[[nodiscard]] std::vector<Blackboard::Ptr> BlackboardBackup(const AnyTree& tree) {
  std::vector<Blackboard::Ptr> backup;
  for (const auto& subtree : tree.subtrees) {
    backup.push_back(Blackboard::create());
    subtree->blackboard->cloneInto(*backup.back());
  }
  return backup;
}
// Throws when it is of a tree with other boards.
template <class AnyTree>
void BlackboardRestore(const std::vector<Blackboard::Ptr>& backup, AnyTree& tree) {
  if (backup.size() != tree.subtrees.size()) {
    throw LogicError("BlackboardRestore: the backup has ", std::to_string(backup.size()),
                     " boards, the tree ", std::to_string(tree.subtrees.size()));
  }
  for (std::size_t i = 0; i < backup.size(); ++i) {
    backup[i]->cloneInto(*tree.subtrees[i]->blackboard);
  }
}

}  // namespace BT

// Registers the nodes of a plugin.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>

#include "behaviortree_cpp/behavior_tree.h"
#include "behaviortree_cpp/lockstep/documents.h"
#include "behaviortree_cpp/lockstep/enum_names.h"
#include "behaviortree_cpp/lockstep/node_ids.h"
#include "behaviortree_cpp/lockstep/plugin_table.h"
#if __has_include(<lockstep/runtime.h>)
#include "behaviortree_cpp/lockstep/program.h"
#endif

namespace BT {

template <class T, class... Arguments>
NodeBuilder CreateBuilder(Arguments... arguments) {
  return [=](const std::string& name, const NodeConfig& config) {
    return TreeNode::Instantiate<T>(name, config, arguments...);
  };
}

template <class T>
TreeNodeManifest CreateManifest(const std::string& ID, PortsList ports = getProvidedPorts<T>()) {
  TreeNodeManifest manifest{getType<T>(), ID, std::move(ports), {}, lockstep_detail::hooks_of<T>()};
  if constexpr (has_static_method_metadata<T>::value) manifest.metadata = T::metadata();
  return manifest;
}

class BehaviorTreeFactory {
 public:
  BehaviorTreeFactory() = default;
  BehaviorTreeFactory(const BehaviorTreeFactory&) = delete;
  BehaviorTreeFactory& operator=(const BehaviorTreeFactory&) = delete;
  BehaviorTreeFactory(BehaviorTreeFactory&&) = default;
  BehaviorTreeFactory& operator=(BehaviorTreeFactory&&) = default;

  // A class of nodes by its ID; `arguments` go to the end of its constructor.
  template <class T, class... Arguments>
  void registerNodeType(const std::string& ID, const PortsList& ports, Arguments... arguments) {
    static_assert(std::is_base_of_v<TreeNode, T>,
                  "a class of nodes derives from a node of BT, such as BT::SyncActionNode");
    static_assert(!std::is_abstract_v<T>,
                  "this class is abstract: it lacks a function that its base asks for, such as "
                  "tick(), or onStart(), onRunning() and onHalted()");
    lockstep_check_class<T, Arguments...>();
    registerBuilder(CreateManifest<T>(ID, ports), CreateBuilder<T>(arguments...));
  }
  template <class T, class... Arguments>
  void registerNodeType(const std::string& ID, Arguments... arguments) {
    static_assert(std::is_base_of_v<TreeNode, T>,
                  "a class of nodes derives from a node of BT, such as BT::SyncActionNode");
    static_assert(!std::is_abstract_v<T>,
                  "this class is abstract: it lacks a function that its base asks for, such as "
                  "tick(), or onStart(), onRunning() and onHalted()");
    constexpr bool kTakesConfig =
        std::is_constructible_v<T, const std::string&, const NodeConfig&, Arguments...>;
    static_assert(!kTakesConfig || has_static_method_providedPorts<T>::value,
                  "a class whose constructor takes a NodeConfig needs a public function: static "
                  "BT::PortsList providedPorts()");
    static_assert(kTakesConfig || !has_static_method_providedPorts<T>::value,
                  "a class with providedPorts() needs a public constructor (const std::string& "
                  "name, const BT::NodeConfig& config), then the arguments of registerNodeType");
    lockstep_check_class<T, Arguments...>();
    registerBuilder(CreateManifest<T>(ID), CreateBuilder<T>(arguments...));
  }

  void registerBuilder(const TreeNodeManifest& manifest, const NodeBuilder& builder) {
    if (builtinNodes().count(manifest.registration_ID) != 0) {
      throw BehaviorTreeException("ID [", manifest.registration_ID, "] is that of a built-in node");
    }
    lockstep_plugin_->add(manifest, builder);
  }
  template <class T>
  void registerBuilder(const std::string& ID, const NodeBuilder& builder) {
    registerBuilder(CreateManifest<T>(ID), builder);
  }

  void registerSimpleAction(const std::string& ID, const SimpleActionNode::TickFunctor& function,
                            PortsList ports = {}) {
    lockstep_add_simple<SimpleActionNode>(NodeType::ACTION, ID, function, std::move(ports));
  }
  void registerSimpleCondition(const std::string& ID,
                               const SimpleConditionNode::TickFunctor& function,
                               PortsList ports = {}) {
    lockstep_add_simple<SimpleConditionNode>(NodeType::CONDITION, ID, function, std::move(ports));
  }

  void registerSimpleDecorator(const std::string& ID,
                               const SimpleDecoratorNode::TickFunctor& function,
                               PortsList ports = {}) {
    lockstep_add_simple<SimpleDecoratorNode>(NodeType::DECORATOR, ID, function, std::move(ports));
  }

  // A word that scripts, and ports of enums, know as a number; all names of an enum.
  void registerScriptingEnum(StringView name, int value) {
    lockstep_plugin_->add_word(std::string(name), value);
  }
  template <class Enum>
  void registerScriptingEnums() {
    lockstep_detail::for_each_name<Enum>(
        [this](StringView name, int value) { registerScriptingEnum(name, value); });
  }

  // For the plugin's own table.
  lockstep_detail::PluginTable& lockstep_table() { return *lockstep_plugin_; }

#if __has_include(<lockstep/runtime.h>)
  // In a program that ticks trees itself. All throw when the tree has errors.
  void registerFromPlugin(const std::string& file) {
    lockstep_plugins_.push_back(file);
  }
  Tree createTreeFromText(const std::string& text,
                          Blackboard::Ptr blackboard = Blackboard::create()) {
    return lockstep_make({lockstep_plugin_, lockstep_plugins_, lockstep_documents_.text(text), "",
                          lockstep_detail::Documents::main_of(text)},
                         std::move(blackboard));
  }
  Tree createTreeFromFile(const std::string& file,
                          Blackboard::Ptr blackboard = Blackboard::create()) {
    if (lockstep_documents_.tree_ids().empty()) {
      return lockstep_make({lockstep_plugin_, lockstep_plugins_, "", file, ""},
                           std::move(blackboard));
    }
    lockstep_detail::Documents all = lockstep_documents_;
    const std::string main = lockstep_detail::Documents::main_of(all.add_file(file));
    return lockstep_make({lockstep_plugin_, lockstep_plugins_, all.text(), "", main},
                         std::move(blackboard));
  }
  // A tree of what was registered; a later tree of the same ID replaces an earlier one.
  void registerBehaviorTreeFromFile(const std::string& file) {
    lockstep_documents_.add_file(file);
  }
  void registerBehaviorTreeFromText(const std::string& text) {
    lockstep_documents_.add_text(text);
  }
  std::vector<std::string> registeredBehaviorTrees() const {
    return lockstep_documents_.tree_ids();
  }
  void clearRegisteredBehaviorTrees() {
    lockstep_documents_ = {};
  }
  Tree createTree(const std::string& tree, Blackboard::Ptr blackboard = Blackboard::create()) {
    return lockstep_make(
        {lockstep_plugin_, lockstep_plugins_, lockstep_documents_.text(), "", tree},
        std::move(blackboard));
  }
#endif
  // What is registered, without the nodes that every tree has.
  const std::unordered_map<std::string, TreeNodeManifest>& manifests() const {
    return lockstep_plugin_->manifests();
  }
  const std::unordered_map<std::string, NodeBuilder>& builders() const {
    return lockstep_plugin_->builders();
  }
  const std::set<std::string>& builtinNodes() const {
    return lockstep_detail::node_ids();
  }
  // False: it is not registered.
  bool unregisterBuilder(const std::string& ID) {
    if (builtinNodes().count(ID) != 0) throw LogicError("the node '", ID, "' cannot be removed");
    return lockstep_plugin_->remove(ID);
  }
  void addMetadataToManifest(const std::string& node_ID, const KeyValueVector& metadata) {
    const auto found = lockstep_plugin_->manifests().find(node_ID);
    if (found == lockstep_plugin_->manifests().end()) {
      throw RuntimeError("addMetadataToManifest: ID [", node_ID, "] is not registered");
    }
    found->second.metadata = metadata;
  }
  // A node that is in no tree.
  [[nodiscard]] std::unique_ptr<TreeNode> instantiateTreeNode(const std::string& name,
                                                              const std::string& ID,
                                                              const NodeConfig& config) const {
    const auto builder = builders().find(ID);
    if (builder == builders().end()) throw RuntimeError("ID [", ID, "] is not registered");
    auto node = builder->second(name, config);
    node->setRegistrationID(ID);
    return node;
  }

  template <class Derived, class Base>
  void registerPolymorphicCast() {
    static_assert(sizeof(Derived) == 0,
                  "lockstep has no polymorphic casts: give the port the type of the base, "
                  "std::shared_ptr<Base>");
  }
  template <class Text>
  void loadSubstitutionRuleFromJSON(const Text&) {
    static_assert(sizeof(Text) == 0,
                  "lockstep has no substitution rules: 'lockstep run --mock-leaf ID=failure' "
                  "replaces a leaf for a test");
  }
  void clearSubstitutionRules() {}
  template <class Filter, class Rule>
  void addSubstitutionRule(const Filter&, const Rule&) {
    static_assert(sizeof(Rule) == 0,
                  "lockstep has no substitution rules: 'lockstep run --mock-leaf ID=failure' "
                  "replaces a leaf for a test");
  }

 private:
  template <class T, class... Arguments>
  static constexpr void lockstep_check_class() {
    static_assert(std::is_constructible_v<T, const std::string&, const NodeConfig&, Arguments...> ||
                      std::is_constructible_v<T, const std::string&, Arguments...>,
                  "a class of nodes has a public constructor (const std::string& name, const "
                  "BT::NodeConfig& config) or (const std::string& name), then the arguments of "
                  "registerNodeType");
  }

  template <class Node, class Function>
  void lockstep_add_simple(NodeType type, const std::string& id, const Function& function,
                           PortsList ports) {
    registerBuilder(
        TreeNodeManifest{type, id, std::move(ports), {}, lockstep_detail::hooks_of<Node>()},
        [function](const std::string& name, const NodeConfig& config) {
          return std::make_unique<Node>(name, function, config);
        });
  }

#if __has_include(<lockstep/runtime.h>)
  static Tree lockstep_make(lockstep_detail::Program::Source source, Blackboard::Ptr blackboard) {
    return {std::make_shared<lockstep_detail::Program>(std::move(source)), std::move(blackboard)};
  }
#endif

  std::shared_ptr<lockstep_detail::PluginTable> lockstep_plugin_ =
      std::make_shared<lockstep_detail::PluginTable>();
  std::vector<std::string> lockstep_plugins_;
  lockstep_detail::Documents lockstep_documents_;  // of createTree
};

}  // namespace BT

#include "behaviortree_cpp/lockstep/plugin_entry.h"  // IWYU pragma: export

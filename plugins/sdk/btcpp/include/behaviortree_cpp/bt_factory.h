// Registers the nodes of a plugin.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>

#include "behaviortree_cpp/behavior_tree.h"
#include "behaviortree_cpp/lockstep/enum_names.h"
#include "behaviortree_cpp/lockstep/node_ids.h"
#include "behaviortree_cpp/lockstep/registration.h"
#if __has_include(<lockstep/runtime.h>)
#include "behaviortree_cpp/lockstep/substitution_rule.h"
#include "behaviortree_cpp/lockstep/tree.h"
#endif
#include "behaviortree_cpp/lockstep/visiting.h"  // IWYU pragma: export

namespace BT {
namespace lockstep_detail {
class Documents;
class PluginTable;
struct FactoryTrees;
struct XmlElement;
}  // namespace lockstep_detail

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
  BehaviorTreeFactory();
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

  void registerBuilder(const TreeNodeManifest& manifest, const NodeBuilder& builder);
  template <class T>
  void registerBuilder(const std::string& ID, const NodeBuilder& builder) {
    registerBuilder(CreateManifest<T>(ID), builder);
  }

  void registerSimpleAction(const std::string& ID, const SimpleActionNode::TickFunctor& function,
                            PortsList ports = {});
  void registerSimpleCondition(const std::string& ID,
                               const SimpleConditionNode::TickFunctor& function,
                               PortsList ports = {});
  void registerSimpleDecorator(const std::string& ID,
                               const SimpleDecoratorNode::TickFunctor& function,
                               PortsList ports = {});

  // A word that scripts, and ports of enums, know as a number; all names of an enum.
  void registerScriptingEnum(StringView name, int value);
  template <class Enum>
  void registerScriptingEnums() {
    lockstep_detail::for_each_name<Enum>(
        [this](StringView name, int value) { registerScriptingEnum(name, value); });
  }

  // For the plugin's own table.
  lockstep_detail::PluginTable& lockstep_table() { return *lockstep_plugin_; }

#if __has_include(<lockstep/runtime.h>)
  // In a program that ticks trees itself. All throw when a tree has errors.
  void registerFromPlugin(const std::string& file);
  [[nodiscard]] Tree createTreeFromText(const std::string& text,
                                        Blackboard::Ptr blackboard = Blackboard::create());
  [[nodiscard]] Tree createTreeFromFile(const std::filesystem::path& file,
                                        Blackboard::Ptr blackboard = Blackboard::create());
  // A tree of what was registered; a later tree of the same ID replaces an earlier one.
  void registerBehaviorTreeFromFile(const std::filesystem::path& file);
  void registerBehaviorTreeFromText(const std::string& text);
  [[nodiscard]] std::vector<std::string> registeredBehaviorTrees() const;
  void clearRegisteredBehaviorTrees();
  [[nodiscard]] Tree createTree(const std::string& tree,
                                Blackboard::Ptr blackboard = Blackboard::create());

  // A rule takes the place of nodes in trees that are made from now on: `filter` is the name of a
  // node, its ID, or a pattern of its path, with * and ?. A rule is the ID of a registered node, or
  // what a TestNode does.
  using SubstitutionRule = lockstep_detail::SubstitutionRule;
  void addSubstitutionRule(StringView filter, SubstitutionRule rule);
  // Adds those of {"TestNodeConfigs": {…}, "SubstitutionRules": {…}}.
  void loadSubstitutionRuleFromJSON(const std::string& text);
  void clearSubstitutionRules();
  [[nodiscard]] const std::unordered_map<std::string, SubstitutionRule>& substitutionRules() const;

  // For an XMLParser: what refuses a document, and a tree of documents.
  std::function<void(const lockstep_detail::XmlElement& root)> lockstep_check() const;
  Tree lockstep_make(const lockstep_detail::Documents& documents, const std::string& main,
                     Blackboard::Ptr blackboard) const;
#endif
  // The registered nodes, and those that every tree has.
  const std::unordered_map<std::string, TreeNodeManifest>& manifests() const;
  const std::unordered_map<std::string, NodeBuilder>& builders() const;
  const std::set<std::string>& builtinNodes() const;
  // False: it is not registered.
  bool unregisterBuilder(const std::string& ID);
  void addMetadataToManifest(const std::string& node_ID, const KeyValueVector& metadata);
  // A node that is in no tree.
  [[nodiscard]] std::unique_ptr<TreeNode> instantiateTreeNode(const std::string& name,
                                                              const std::string& ID,
                                                              const NodeConfig& config) const;

  // Ports of std::shared_ptr<Base> read entries of std::shared_ptr<Derived>; those of Derived read
  // entries of Base that point to a Derived.
  template <class Derived, class Base>
  void registerPolymorphicCast() {
    lockstep_detail::object_type<std::shared_ptr<Derived>>();
    lockstep_detail::object_type<std::shared_ptr<Base>>();
    polymorphicCastRegistry().registerCast<Derived, Base>();
  }
  [[nodiscard]] PolymorphicCastRegistry& polymorphicCastRegistry();
  [[nodiscard]] const PolymorphicCastRegistry& polymorphicCastRegistry() const;
  [[nodiscard]] std::shared_ptr<PolymorphicCastRegistry> polymorphicCastRegistryPtr() const;

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
                           PortsList ports);
#if __has_include(<lockstep/runtime.h>)
  lockstep_detail::FactoryTrees& lockstep_trees();
  const lockstep_detail::FactoryTrees& lockstep_trees() const;
  Tree lockstep_make_and_keep(lockstep_detail::Documents documents, const std::string& main,
                              Blackboard::Ptr blackboard);
  void lockstep_add_test_node() const;
#endif

  std::shared_ptr<lockstep_detail::PluginTable> lockstep_plugin_;
  std::shared_ptr<lockstep_detail::FactoryTrees> lockstep_trees_;  // null: a program has none yet
};

}  // namespace BT

#include "behaviortree_cpp/lockstep/plugin_entry.h"  // IWYU pragma: export
#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/factory.h"
#if __has_include(<lockstep/runtime.h>) && !defined(LOCKSTEP_BTCPP_MAKES_LIBRARY)
#include "behaviortree_cpp/lockstep/compiled/factory_programs.h"
#endif
#endif
#if __has_include(<nlohmann/json.hpp>)
#include "behaviortree_cpp/json_export.h"  // IWYU pragma: export
#endif

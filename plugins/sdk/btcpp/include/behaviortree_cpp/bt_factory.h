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
#include "behaviortree_cpp/lockstep/plugin_table.h"
#if __has_include(<lockstep/runtime.h>)
#include "behaviortree_cpp/lockstep/document_check.h"
#include "behaviortree_cpp/lockstep/documents.h"
#include "behaviortree_cpp/lockstep/outline.h"
#include "behaviortree_cpp/lockstep/program.h"
#endif
#include "behaviortree_cpp/lockstep/visiting.h"  // IWYU pragma: export

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
    for (const auto& [name, port] : manifest.ports) lockstep_detail::check_port_name(name);
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
  // In a program that ticks trees itself. All throw when a tree has errors.
  void registerFromPlugin(const std::string& file) {
    if (file.find('/') != std::string::npos && !std::filesystem::exists(file)) {
      throw RuntimeError("the plugin '", file, "' is not there");
    }
    lockstep_plugins_.push_back(file);
  }
  [[nodiscard]] Tree createTreeFromText(const std::string& text,
                                        Blackboard::Ptr blackboard = Blackboard::create()) {
    lockstep_detail::Documents all = lockstep_documents_;
    const std::string main = all.add_text(text, lockstep_check());
    return lockstep_make_and_keep(std::move(all), main, std::move(blackboard));
  }
  [[nodiscard]] Tree createTreeFromFile(const std::filesystem::path& file,
                                        Blackboard::Ptr blackboard = Blackboard::create()) {
    lockstep_detail::Documents all = lockstep_documents_;
    const std::string main = all.add_file(file, lockstep_check());
    return lockstep_make_and_keep(std::move(all), main, std::move(blackboard));
  }
  // A tree of what was registered; a later tree of the same ID replaces an earlier one.
  void registerBehaviorTreeFromFile(const std::filesystem::path& file) {
    lockstep_documents_.add_file(file, lockstep_check());
  }
  void registerBehaviorTreeFromText(const std::string& text) {
    lockstep_documents_.add_text(text, lockstep_check());
  }
  [[nodiscard]] std::vector<std::string> registeredBehaviorTrees() const {
    return lockstep_documents_.tree_ids();
  }
  void clearRegisteredBehaviorTrees() {
    lockstep_documents_ = {};
  }
  [[nodiscard]] Tree createTree(const std::string& tree,
                                Blackboard::Ptr blackboard = Blackboard::create()) {
    if (lockstep_documents_.set().trees.count(tree) == 0) {
      throw std::runtime_error(StrCat(
          "no tree '", tree, "' is registered: registerBehaviorTreeFromFile() and -Text() do it"));
    }
    return lockstep_make(lockstep_documents_, tree, std::move(blackboard));
  }

  // What takes the place of nodes in trees that are made from now on: `filter` is the name of a
  // node, its ID, or a pattern of its path, with * and ?. A rule is the ID of a registered node, or
  // what a TestNode does.
  using SubstitutionRule = lockstep_detail::SubstitutionRule;
  void addSubstitutionRule(StringView filter, SubstitutionRule rule) {
    lockstep_rules_[std::string(filter)] = std::move(rule);
  }
  // Adds those of {"TestNodeConfigs": {…}, "SubstitutionRules": {…}}.
  void loadSubstitutionRuleFromJSON(const std::string& text) {
    for (auto& [filter, rule] : lockstep_detail::rules_from_json(text)) {
      lockstep_rules_[filter] = rule;
    }
  }
  void clearSubstitutionRules() {
    lockstep_rules_.clear();
  }
  [[nodiscard]] const std::unordered_map<std::string, SubstitutionRule>& substitutionRules() const {
    return lockstep_rules_;
  }

  // For an XMLParser: what refuses a document, and a tree of documents.
  lockstep_detail::Documents::Check lockstep_check() const {
    return lockstep_detail::DocumentCheck(
        [table = lockstep_plugin_](const std::string& id) {
          const TreeNodeManifest* const manifest = table->manifest(id);
          return manifest == nullptr ? NodeType::UNDEFINED : manifest->type;
        },
        lockstep_plugins_.empty());
  }
  Tree lockstep_make(const lockstep_detail::Documents& documents, const std::string& main,
                     Blackboard::Ptr blackboard) const {
    auto loaded = documents.loaded(main);
    auto& table = *lockstep_plugin_;
    auto outline =
        lockstep_detail::OutlineMaker(documents.set(), lockstep_rules_, table.manifests())
            .make(main);
    if (outline != nullptr) {
      lockstep_detail::check_constants(*outline, table.manifests(), *table.words());
      if (!outline->text.empty()) loaded = {outline->text, "", main};
      if (!outline->tests.empty()) lockstep_add_test_node();
    }
    if (blackboard == nullptr || blackboard->lockstep_is_attached()) {
      blackboard = Blackboard::create(std::move(blackboard));  // another tree has it: a parent
      blackboard->enableAutoRemapping(true);
    }
    return Tree(std::make_shared<lockstep_detail::Program>(lockstep_detail::Program::Source{
        lockstep_plugin_, lockstep_plugins_, std::move(loaded.text), std::move(loaded.file),
        std::move(loaded.main_tree), std::move(blackboard), std::move(outline)}));
  }
#endif
  // What is registered, and the nodes that every tree has.
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
      throw std::runtime_error(
          StrCat("addMetadataToManifest: ID [", node_ID, "] is not registered"));
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

  // Ports of std::shared_ptr<Base> read entries of std::shared_ptr<Derived>; those of Derived read
  // entries of Base that point to a Derived.
  template <class Derived, class Base>
  void registerPolymorphicCast() {
    lockstep_detail::object_type<std::shared_ptr<Derived>>();
    lockstep_detail::object_type<std::shared_ptr<Base>>();
    polymorphicCastRegistry().registerCast<Derived, Base>();
  }
  [[nodiscard]] PolymorphicCastRegistry& polymorphicCastRegistry() {
    return *lockstep_plugin_->casts();
  }
  [[nodiscard]] const PolymorphicCastRegistry& polymorphicCastRegistry() const {
    return *lockstep_plugin_->casts();
  }
  [[nodiscard]] std::shared_ptr<PolymorphicCastRegistry> polymorphicCastRegistryPtr() const {
    return lockstep_plugin_->casts();
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
  // The trees of the document are registered from now on, as those of the library are; one without
  // an ID can only be made here.
  Tree lockstep_make_and_keep(lockstep_detail::Documents documents, const std::string& main,
                              Blackboard::Ptr blackboard) {
    Tree tree = lockstep_make(documents, main, std::move(blackboard));
    if (!documents.has_unnamed()) lockstep_documents_ = std::move(documents);
    return tree;
  }
  // The leaf that trees have where a rule has put a TestNode.
  void lockstep_add_test_node() const {
    TreeNodeManifest manifest;
    manifest.type = NodeType::ACTION;
    manifest.registration_ID = lockstep_detail::kTestNodeId;
    manifest.ports = {InputPort<Any>(TestNode::kLockstepPort)};
    lockstep_plugin_->add_unlisted(
        manifest,
        [table = lockstep_plugin_.get()](const std::string& name, const NodeConfig& config) {
          const auto test = table->tests.find(config.path);
          if (test == table->tests.end()) {
            throw LogicError("'", name, "' stands for a TestNode, but no rule is for '",
                             config.path, "'");
          }
          return std::make_unique<TestNode>(name, config, test->second);
        });
  }
#endif

  std::shared_ptr<lockstep_detail::PluginTable> lockstep_plugin_ =
      std::make_shared<lockstep_detail::PluginTable>();
  std::vector<std::string> lockstep_plugins_;
#if __has_include(<lockstep/runtime.h>)
  lockstep_detail::Documents lockstep_documents_;  // of createTree
  lockstep_detail::SubstitutionRules lockstep_rules_;
#endif
};

}  // namespace BT

#include "behaviortree_cpp/lockstep/plugin_entry.h"  // IWYU pragma: export
#if __has_include(<nlohmann/json.hpp>)
#include "behaviortree_cpp/json_export.h"  // IWYU pragma: export
#endif

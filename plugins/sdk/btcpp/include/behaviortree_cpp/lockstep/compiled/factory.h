// The functions of bt_factory.h that register nodes. Included by it.
#pragma once

#include <dlfcn.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/lockstep/plugin_table.h"

namespace BT {

LOCKSTEP_BTCPP_INLINE BehaviorTreeFactory::BehaviorTreeFactory()
    : lockstep_plugin_(std::make_shared<lockstep_detail::PluginTable>()) {}

LOCKSTEP_BTCPP_INLINE void BehaviorTreeFactory::registerBuilder(const TreeNodeManifest& manifest,
                                                                const NodeBuilder& builder) {
  if (builtinNodes().count(manifest.registration_ID) != 0) {
    throw BehaviorTreeException("ID [", manifest.registration_ID, "] is that of a built-in node");
  }
  for (const auto& [name, port] : manifest.ports) lockstep_detail::check_port_name(name);
  lockstep_plugin_->add(manifest, builder);
}

template <class Node, class Function>
void BehaviorTreeFactory::lockstep_add_simple(NodeType type, const std::string& id,
                                              const Function& function, PortsList ports) {
  registerBuilder(
      TreeNodeManifest{type, id, std::move(ports), {}, lockstep_detail::hooks_of<Node>()},
      [function](const std::string& name, const NodeConfig& config) {
        return std::make_unique<Node>(name, function, config);
      });
}
LOCKSTEP_BTCPP_INLINE void BehaviorTreeFactory::registerSimpleAction(
    const std::string& ID, const SimpleActionNode::TickFunctor& function, PortsList ports) {
  lockstep_add_simple<SimpleActionNode>(NodeType::ACTION, ID, function, std::move(ports));
}
LOCKSTEP_BTCPP_INLINE void BehaviorTreeFactory::registerSimpleCondition(
    const std::string& ID, const SimpleConditionNode::TickFunctor& function, PortsList ports) {
  lockstep_add_simple<SimpleConditionNode>(NodeType::CONDITION, ID, function, std::move(ports));
}
LOCKSTEP_BTCPP_INLINE void BehaviorTreeFactory::registerSimpleDecorator(
    const std::string& ID, const SimpleDecoratorNode::TickFunctor& function, PortsList ports) {
  lockstep_add_simple<SimpleDecoratorNode>(NodeType::DECORATOR, ID, function, std::move(ports));
}

LOCKSTEP_BTCPP_INLINE void BehaviorTreeFactory::registerScriptingEnum(StringView name, int value) {
  lockstep_plugin_->add_word(std::string(name), value);
}

LOCKSTEP_BTCPP_INLINE const std::unordered_map<std::string, TreeNodeManifest>&
BehaviorTreeFactory::manifests() const {
  return lockstep_plugin_->manifests();
}
LOCKSTEP_BTCPP_INLINE const std::unordered_map<std::string, NodeBuilder>&
BehaviorTreeFactory::builders() const {
  return lockstep_plugin_->builders();
}
LOCKSTEP_BTCPP_INLINE const std::set<std::string>& BehaviorTreeFactory::builtinNodes() const {
  return lockstep_detail::node_ids();
}
LOCKSTEP_BTCPP_INLINE bool BehaviorTreeFactory::unregisterBuilder(const std::string& ID) {
  if (builtinNodes().count(ID) != 0) throw LogicError("the node '", ID, "' cannot be removed");
  return lockstep_plugin_->remove(ID);
}
LOCKSTEP_BTCPP_INLINE void BehaviorTreeFactory::addMetadataToManifest(
    const std::string& node_ID, const KeyValueVector& metadata) {
  const auto found = lockstep_plugin_->manifests().find(node_ID);
  if (found == lockstep_plugin_->manifests().end()) {
    throw std::runtime_error(StrCat("addMetadataToManifest: ID [", node_ID, "] is not registered"));
  }
  found->second.metadata = metadata;
}
LOCKSTEP_BTCPP_INLINE std::unique_ptr<TreeNode> BehaviorTreeFactory::instantiateTreeNode(
    const std::string& name, const std::string& ID, const NodeConfig& config) const {
  const auto builder = builders().find(ID);
  if (builder == builders().end()) throw RuntimeError("ID [", ID, "] is not registered");
  auto node = builder->second(name, config);
  node->setRegistrationID(ID);
  return node;
}

LOCKSTEP_BTCPP_INLINE PolymorphicCastRegistry& BehaviorTreeFactory::polymorphicCastRegistry() {
  return *lockstep_plugin_->casts();
}
LOCKSTEP_BTCPP_INLINE const PolymorphicCastRegistry& BehaviorTreeFactory::polymorphicCastRegistry()
    const {
  return *lockstep_plugin_->casts();
}
LOCKSTEP_BTCPP_INLINE std::shared_ptr<PolymorphicCastRegistry>
BehaviorTreeFactory::polymorphicCastRegistryPtr() const {
  return lockstep_plugin_->casts();
}

// --- of plugin_entry.h

namespace lockstep_detail {

// One for each shared object; it lives until the process ends.
[[gnu::visibility("hidden")]] inline BehaviorTreeFactory& plugin_factory() {
  static auto& factory = *new BehaviorTreeFactory;
  return factory;
}

LOCKSTEP_BTCPP_INLINE PluginTable& made_table() {
  return making != nullptr ? *making : plugin_factory().lockstep_table();
}
LOCKSTEP_BTCPP_INLINE bool reads_object(std::type_index type, const char* name) {
  const auto sources = made_table().casts()->lockstep_sources(type);
  return std::any_of(sources.begin(), sources.end(),
                     [name](std::type_index it) { return object_name(it) == name; });
}
LOCKSTEP_BTCPP_INLINE const Registration* find_registration(const std::string& id) {
  return made_table().find(id);
}
LOCKSTEP_BTCPP_INLINE const NodeNumber* number_of(const std::string& path) {
  if (making == nullptr) return nullptr;
  const auto found = making->numbers.find(path);
  return found == making->numbers.end() ? nullptr : &found->second;
}
LOCKSTEP_BTCPP_INLINE void note_made(const std::string& path, TreeNode& node) {
  if (making != nullptr) making->made[path] = &node;
}
LOCKSTEP_BTCPP_INLINE const std::shared_ptr<PolymorphicCastRegistry>& registered_casts() {
  return made_table().casts();
}
LOCKSTEP_BTCPP_INLINE const std::shared_ptr<ScriptingEnumsRegistry>& registered_enums() {
  return made_table().words();
}

// The name of the file without "lib" in front and what is behind the first point.
LOCKSTEP_BTCPP_INLINE std::string plugin_name(const void* in_plugin) {
  Dl_info info{};
  if (dladdr(in_plugin, &info) == 0 || info.dli_fname == nullptr) return "plugin";
  std::string name = info.dli_fname;
  name.erase(0, name.rfind('/') + 1);
  name.erase(std::min(name.find('.'), name.size()));
  return StartWith(name, "lib") ? name.substr(3) : name;
}

LOCKSTEP_BTCPP_INLINE const lockstep_plugin* describe(void (*register_nodes)(BehaviorTreeFactory&),
                                                      const void* here, std::string& error) {
  const lockstep_plugin* described = nullptr;
  lockstep::detail::catching(
      [&] {
        register_nodes(plugin_factory());
        described = &plugin_factory().lockstep_table().describe(plugin_name(here), table_extension);
      },
      [&error](const char* message) { error = message; });
  return described;
}

}  // namespace lockstep_detail
}  // namespace BT

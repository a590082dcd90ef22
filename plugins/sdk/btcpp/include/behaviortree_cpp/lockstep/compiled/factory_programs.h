// The functions of bt_factory.h that make trees. Included by it.
#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/lockstep/document_check.h"
#include "behaviortree_cpp/lockstep/documents.h"
#include "behaviortree_cpp/lockstep/outline.h"
#include "behaviortree_cpp/lockstep/plugin_table.h"
#include "behaviortree_cpp/lockstep/program.h"

namespace BT {
namespace lockstep_detail {

// The trees that a program has given to its factory.
struct FactoryTrees {
  std::vector<std::string> plugins;
  Documents documents;
  SubstitutionRules rules;
};

// For a factory without trees.
inline const FactoryTrees& no_trees() {
  static const FactoryTrees none;
  return none;
}

}  // namespace lockstep_detail

LOCKSTEP_BTCPP_INLINE lockstep_detail::FactoryTrees& BehaviorTreeFactory::lockstep_trees() {
  if (lockstep_trees_ == nullptr) {
    lockstep_trees_ = std::make_shared<lockstep_detail::FactoryTrees>();
  }
  return *lockstep_trees_;
}
LOCKSTEP_BTCPP_INLINE const lockstep_detail::FactoryTrees& BehaviorTreeFactory::lockstep_trees()
    const {
  return lockstep_trees_ == nullptr ? lockstep_detail::no_trees() : *lockstep_trees_;
}

LOCKSTEP_BTCPP_INLINE void BehaviorTreeFactory::registerFromPlugin(const std::string& file) {
  if (file.find('/') != std::string::npos && !std::filesystem::exists(file)) {
    throw RuntimeError("the plugin '", file, "' is not there");
  }
  lockstep_trees().plugins.push_back(file);
}
LOCKSTEP_BTCPP_INLINE Tree BehaviorTreeFactory::createTreeFromText(const std::string& text,
                                                                   Blackboard::Ptr blackboard) {
  lockstep_detail::Documents all = lockstep_trees().documents;
  const std::string main = all.add_text(text, lockstep_check());
  return lockstep_make_and_keep(std::move(all), main, std::move(blackboard));
}
LOCKSTEP_BTCPP_INLINE Tree BehaviorTreeFactory::createTreeFromFile(
    const std::filesystem::path& file, Blackboard::Ptr blackboard) {
  lockstep_detail::Documents all = lockstep_trees().documents;
  const std::string main = all.add_file(file, lockstep_check());
  return lockstep_make_and_keep(std::move(all), main, std::move(blackboard));
}
LOCKSTEP_BTCPP_INLINE void BehaviorTreeFactory::registerBehaviorTreeFromFile(
    const std::filesystem::path& file) {
  lockstep_trees().documents.add_file(file, lockstep_check());
}
LOCKSTEP_BTCPP_INLINE void BehaviorTreeFactory::registerBehaviorTreeFromText(
    const std::string& text) {
  lockstep_trees().documents.add_text(text, lockstep_check());
}
LOCKSTEP_BTCPP_INLINE std::vector<std::string> BehaviorTreeFactory::registeredBehaviorTrees()
    const {
  return lockstep_trees().documents.tree_ids();
}
LOCKSTEP_BTCPP_INLINE void BehaviorTreeFactory::clearRegisteredBehaviorTrees() {
  lockstep_trees().documents = {};
}
LOCKSTEP_BTCPP_INLINE Tree BehaviorTreeFactory::createTree(const std::string& tree,
                                                           Blackboard::Ptr blackboard) {
  if (lockstep_trees().documents.set().trees.count(tree) == 0) {
    throw std::runtime_error(StrCat(
        "no tree '", tree, "' is registered: registerBehaviorTreeFromFile() and -Text() do it"));
  }
  return lockstep_make(lockstep_trees().documents, tree, std::move(blackboard));
}

LOCKSTEP_BTCPP_INLINE void BehaviorTreeFactory::addSubstitutionRule(StringView filter,
                                                                    SubstitutionRule rule) {
  lockstep_trees().rules[std::string(filter)] = std::move(rule);
}
LOCKSTEP_BTCPP_INLINE void BehaviorTreeFactory::loadSubstitutionRuleFromJSON(
    const std::string& text) {
  for (auto& [filter, rule] : lockstep_detail::rules_from_json(text)) {
    lockstep_trees().rules[filter] = rule;
  }
}
LOCKSTEP_BTCPP_INLINE void BehaviorTreeFactory::clearSubstitutionRules() {
  lockstep_trees().rules.clear();
}
LOCKSTEP_BTCPP_INLINE const std::unordered_map<std::string, BehaviorTreeFactory::SubstitutionRule>&
BehaviorTreeFactory::substitutionRules() const {
  return lockstep_trees().rules;
}

LOCKSTEP_BTCPP_INLINE std::function<void(const lockstep_detail::XmlElement& root)>
BehaviorTreeFactory::lockstep_check() const {
  return lockstep_detail::DocumentCheck(
      [table = lockstep_plugin_](const std::string& id) {
        const TreeNodeManifest* const manifest = table->manifest(id);
        return manifest == nullptr ? NodeType::UNDEFINED : manifest->type;
      },
      lockstep_trees().plugins.empty());
}
LOCKSTEP_BTCPP_INLINE Tree
BehaviorTreeFactory::lockstep_make(const lockstep_detail::Documents& documents,
                                   const std::string& main, Blackboard::Ptr blackboard) const {
  auto loaded = documents.loaded(main);
  auto& table = *lockstep_plugin_;
  auto outline =
      lockstep_detail::OutlineMaker(documents.set(), lockstep_trees().rules, table.manifests())
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
      lockstep_plugin_, lockstep_trees().plugins, std::move(loaded.text), std::move(loaded.file),
      std::move(loaded.main_tree), std::move(blackboard), std::move(outline)}));
}
// The trees of the document are registered from now on, as those of the library are; one without
// an ID can only be made here.
LOCKSTEP_BTCPP_INLINE Tree BehaviorTreeFactory::lockstep_make_and_keep(
    lockstep_detail::Documents documents, const std::string& main, Blackboard::Ptr blackboard) {
  Tree tree = lockstep_make(documents, main, std::move(blackboard));
  if (!documents.has_unnamed()) lockstep_trees().documents = std::move(documents);
  return tree;
}
// The leaf that trees have where a rule has put a TestNode.
LOCKSTEP_BTCPP_INLINE void BehaviorTreeFactory::lockstep_add_test_node() const {
  TreeNodeManifest manifest;
  manifest.type = NodeType::ACTION;
  manifest.registration_ID = lockstep_detail::kTestNodeId;
  manifest.ports = {InputPort<Any>(TestNode::kLockstepPort)};
  lockstep_plugin_->add_unlisted(manifest, [table = lockstep_plugin_.get()](
                                               const std::string& name, const NodeConfig& config) {
    const auto test = table->tests.find(config.path);
    if (test == table->tests.end()) {
      throw LogicError("'", name, "' stands for a TestNode, but no rule is for '", config.path,
                       "'");
    }
    return std::make_unique<TestNode>(name, config, test->second);
  });
}

}  // namespace BT

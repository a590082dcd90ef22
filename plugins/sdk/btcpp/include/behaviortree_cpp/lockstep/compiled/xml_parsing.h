// The functions of xml_parsing.h. Included by it.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "behaviortree_cpp/lockstep/document_check.h"
#include "behaviortree_cpp/lockstep/written_documents.h"
#if __has_include(<lockstep/runtime.h>)
#include "behaviortree_cpp/lockstep/program.h"
#endif
#include "behaviortree_cpp/xml_parsing.h"

namespace BT {

#if __has_include(<lockstep/runtime.h>)
LOCKSTEP_BTCPP_INLINE XMLParser::XMLParser(const BehaviorTreeFactory& factory)
    : lockstep_factory_(&factory),
      lockstep_documents_(std::make_unique<lockstep_detail::Documents>()) {}
LOCKSTEP_BTCPP_INLINE XMLParser::XMLParser(XMLParser&&) noexcept = default;
LOCKSTEP_BTCPP_INLINE XMLParser& XMLParser::operator=(XMLParser&&) noexcept = default;
LOCKSTEP_BTCPP_INLINE XMLParser::~XMLParser() = default;

LOCKSTEP_BTCPP_INLINE void XMLParser::loadFromFile(const std::filesystem::path& file,
                                                   bool add_includes) {
  lockstep_documents_->add_file(file, lockstep_factory_->lockstep_check(), add_includes);
}
LOCKSTEP_BTCPP_INLINE void XMLParser::loadFromText(const std::string& text, bool add_includes) {
  lockstep_documents_->add_text(text, lockstep_factory_->lockstep_check(), add_includes);
}
LOCKSTEP_BTCPP_INLINE std::vector<std::string> XMLParser::registeredBehaviorTrees() const {
  return lockstep_documents_->tree_ids();
}
LOCKSTEP_BTCPP_INLINE Tree XMLParser::instantiateTree(const Blackboard::Ptr& root_blackboard,
                                                      std::string main_tree_to_execute) {
  if (main_tree_to_execute.empty()) main_tree_to_execute = lockstep_documents_->named_main();
  const auto& trees = lockstep_documents_->set().trees;
  if (main_tree_to_execute.empty() && trees.size() == 1) {
    main_tree_to_execute = trees.begin()->first;
  }
  if (trees.count(main_tree_to_execute) == 0) {
    throw RuntimeError(main_tree_to_execute.empty()
                           ? "which tree is the main one? Give instantiateTree its ID, or the "
                             "root the attribute main_tree_to_execute"
                           : StrCat("no tree '", main_tree_to_execute, "' was loaded"));
  }
  return lockstep_factory_->lockstep_make(*lockstep_documents_, main_tree_to_execute,
                                          root_blackboard);
}
LOCKSTEP_BTCPP_INLINE void XMLParser::clearInternalState() {
  *lockstep_documents_ = {};
}
#endif

LOCKSTEP_BTCPP_INLINE void VerifyXML(
    const std::string& xml_text,
    const std::unordered_map<std::string, NodeType>& registered_nodes) {
  lockstep_detail::DocumentCheck(
      [&registered_nodes](const std::string& id) {
        const auto found = registered_nodes.find(id);
        return found == registered_nodes.end() ? NodeType::UNDEFINED : found->second;
      },
      true)(lockstep_detail::read_xml(xml_text));
}

LOCKSTEP_BTCPP_INLINE std::string writeTreeNodesModelXML(const BehaviorTreeFactory& factory,
                                                         bool include_builtin) {
  lockstep_detail::XmlElement root = lockstep_detail::written_root();
  root.children.push_back(lockstep_detail::written_models(
      factory.manifests(), include_builtin ? std::set<std::string>() : factory.builtinNodes()));
  return lockstep_detail::write_xml(root);
}

LOCKSTEP_BTCPP_INLINE std::string writeTreeXSD(const BehaviorTreeFactory& factory) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" +
         lockstep_detail::write_xml(lockstep_detail::written_schema(factory.manifests()));
}

#if __has_include(<lockstep/runtime.h>)
LOCKSTEP_BTCPP_INLINE std::string WriteTreeToXML(const Tree& tree, bool add_metadata,
                                                 bool add_builtin_models) {
  const lockstep_detail::Program& program = tree.lockstep_program();
  if (program.outline() == nullptr) {
    throw RuntimeError("WriteTreeToXML: the documents of this tree could not be read");
  }
  lockstep_detail::XmlElement root = lockstep_detail::written_root();
  lockstep_detail::add_trees(*program.outline(), add_metadata, root);
  root.children.push_back(lockstep_detail::written_models(
      tree.manifests, add_builtin_models ? std::set<std::string>() : lockstep_detail::node_ids()));
  return lockstep_detail::write_xml(root);
}
#endif

}  // namespace BT

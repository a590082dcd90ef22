// Documents of trees: read for a factory, and written from what it and its trees have.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "behaviortree_cpp/bt_parser.h"
#include "behaviortree_cpp/lockstep/document_check.h"
#include "behaviortree_cpp/lockstep/written_documents.h"

namespace BT {

#if __has_include(<lockstep/runtime.h>)  // where a program can make trees
// Trees beside those that its factory has registered. The factory outlives it.
class XMLParser : public Parser {
 public:
  explicit XMLParser(const BehaviorTreeFactory& factory) : lockstep_factory_(&factory) {}

  // Throw RuntimeError when the document is not as it should be.
  void loadFromFile(const std::filesystem::path& file, bool add_includes = true) override {
    lockstep_documents_.add_file(file, lockstep_factory_->lockstep_check(), add_includes);
  }
  void loadFromText(const std::string& text, bool add_includes = true) override {
    lockstep_documents_.add_text(text, lockstep_factory_->lockstep_check(), add_includes);
  }
  // Sorted.
  [[nodiscard]] std::vector<std::string> registeredBehaviorTrees() const override {
    return lockstep_documents_.tree_ids();
  }
  // "": the main tree that the first document names, or the only tree.
  [[nodiscard]] Tree instantiateTree(const Blackboard::Ptr& root_blackboard,
                                     std::string main_tree_to_execute = {}) override {
    if (main_tree_to_execute.empty()) main_tree_to_execute = lockstep_documents_.named_main();
    const auto& trees = lockstep_documents_.set().trees;
    if (main_tree_to_execute.empty() && trees.size() == 1) {
      main_tree_to_execute = trees.begin()->first;
    }
    if (trees.count(main_tree_to_execute) == 0) {
      throw RuntimeError(main_tree_to_execute.empty()
                             ? "which tree is the main one? Give instantiateTree its ID, or the "
                               "root the attribute main_tree_to_execute"
                             : StrCat("no tree '", main_tree_to_execute, "' was loaded"));
    }
    return lockstep_factory_->lockstep_make(lockstep_documents_, main_tree_to_execute,
                                            root_blackboard);
  }
  void clearInternalState() override { lockstep_documents_ = {}; }

 private:
  const BehaviorTreeFactory* lockstep_factory_;
  lockstep_detail::Documents lockstep_documents_;
};
#endif

// Throws RuntimeError when it is no document of trees that are made of these nodes.
inline void VerifyXML(const std::string& xml_text,
                      const std::unordered_map<std::string, NodeType>& registered_nodes) {
  lockstep_detail::DocumentCheck(
      [&registered_nodes](const std::string& id) {
        const auto found = registered_nodes.find(id);
        return found == registered_nodes.end() ? NodeType::UNDEFINED : found->second;
      },
      true)(lockstep_detail::read_xml(xml_text));
}

// A document whose TreeNodesModel has the registered nodes, for editors.
[[nodiscard]] inline std::string writeTreeNodesModelXML(const BehaviorTreeFactory& factory,
                                                        bool include_builtin = false) {
  lockstep_detail::XmlElement root = lockstep_detail::written_root();
  root.children.push_back(lockstep_detail::written_models(
      factory.manifests(), include_builtin ? std::set<std::string>() : factory.builtinNodes()));
  return lockstep_detail::write_xml(root);
}

// The schema of trees that are made of the registered nodes.
[[nodiscard]] inline std::string writeTreeXSD(const BehaviorTreeFactory& factory) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" +
         lockstep_detail::write_xml(lockstep_detail::written_schema(factory.manifests()));
}

#if __has_include(<lockstep/runtime.h>)
// A tree with its SubTrees, as its documents have them; `add_metadata`: with the path of each tree
// and the number of each node.
[[nodiscard]] inline std::string WriteTreeToXML(const Tree& tree, bool add_metadata,
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

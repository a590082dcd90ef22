// Documents of trees: read for a factory, and written from what it and its trees have.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "behaviortree_cpp/bt_parser.h"

namespace BT {

#if __has_include(<lockstep/runtime.h>)  // where a program can make trees
// Trees beside those that its factory has registered. The factory outlives it.
class XMLParser : public Parser {
 public:
  explicit XMLParser(const BehaviorTreeFactory& factory);
  XMLParser(const XMLParser&) = delete;
  XMLParser& operator=(const XMLParser&) = delete;
  XMLParser(XMLParser&&) noexcept;
  XMLParser& operator=(XMLParser&&) noexcept;
  ~XMLParser() override;

  // Throw RuntimeError when the document is not as it should be.
  void loadFromFile(const std::filesystem::path& file, bool add_includes = true) override;
  void loadFromText(const std::string& text, bool add_includes = true) override;
  // Sorted.
  [[nodiscard]] std::vector<std::string> registeredBehaviorTrees() const override;
  // "": the main tree that the first document names, or the only tree.
  [[nodiscard]] Tree instantiateTree(const Blackboard::Ptr& root_blackboard,
                                     std::string main_tree_to_execute = {}) override;
  void clearInternalState() override;

 private:
  const BehaviorTreeFactory* lockstep_factory_;
  std::unique_ptr<lockstep_detail::Documents> lockstep_documents_;
};
#endif

// Throws RuntimeError when it is no document of trees that are made of these nodes.
void VerifyXML(const std::string& xml_text,
               const std::unordered_map<std::string, NodeType>& registered_nodes);

// A document whose TreeNodesModel has the registered nodes, for editors.
[[nodiscard]] std::string writeTreeNodesModelXML(const BehaviorTreeFactory& factory,
                                                 bool include_builtin = false);

// The schema of trees that are made of the registered nodes.
[[nodiscard]] std::string writeTreeXSD(const BehaviorTreeFactory& factory);

#if __has_include(<lockstep/runtime.h>)
// A tree with its SubTrees, as its documents have them; `add_metadata`: with the path of each tree
// and the number of each node.
[[nodiscard]] std::string WriteTreeToXML(const Tree& tree, bool add_metadata,
                                         bool add_builtin_models);
#endif

}  // namespace BT

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/xml_parsing.h"  // IWYU pragma: export
#endif

// The texts of a project as they are written, with ${arguments}, for changes that are about all of
// them.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/problem.h"
#include "language/document/document.h"
#include "language/document/project.h"
#include "language/document/text_edit.h"
#include "tree/catalog.h"

namespace lockstep::host {

// An edit of each document, in their order; most are empty.
using ProjectEdit = std::vector<TextEdit>;

// An element of one of the documents.
struct ElementAt {
  std::uint32_t document, element;
};

class ProjectTexts {
 public:
  // `catalog` has the nodes of its plugins: by them an attribute is known as a script.
  // Both must outlive it.
  ProjectTexts(const Project& project, const Catalog& catalog);
  // The same with the values of arguments, which cannot be edited.
  ProjectTexts with_arguments() const;

  std::size_t size() const { return documents_.size(); }
  const Document& document(std::uint32_t index) const { return *documents_[index]; }
  const LanguageRules& rules() const { return *rules_; }
  const Catalog& catalog() const { return catalog_; }

  // Of a file that is included several times, those of the first.
  void for_each_element(const std::function<void(ElementAt)>& visit) const;
  // What <include as="truck"> puts before the IDs in a document: "truck.".
  const std::string& prefix(std::uint32_t document) const { return project_.prefixes[document]; }
  // The documents that are read from the same file as this one: it, if no other is.
  std::vector<std::uint32_t> copies(std::uint32_t document) const;
  // An ID, as the main file calls it.
  std::string full_id(ElementAt at, std::string_view attribute) const;
  // The ID of the tree of a SubTree, as the main file calls it: of an included file, its main tree.
  std::string tree_of(ElementAt sub_tree) const;
  // The name of an included file, which stands for its main tree.
  bool is_named_file(std::string_view name) const;
  // The BehaviorTree with that ID, as the main file calls it.
  std::optional<ElementAt> find_tree(std::string_view id) const;
  // The BehaviorTree around it.
  std::optional<ElementAt> tree_around(ElementAt at) const;
  // "" if it has no such attribute. References are replaced, arguments are not.
  std::string_view value(ElementAt at, std::string_view name) const;
  // That the main file says is run, or the only one.
  std::string_view main_tree() const { return main_tree(0); }
  bool is_sub_tree(ElementAt at) const;
  // The ports of the tree with this ID in a TreeNodesModel, which may have defaults for SubTrees.
  std::vector<ElementAt> modeled_ports(std::string_view tree) const;
  // Null: it is no node, or unknown.
  const NodeType* type_of(ElementAt at) const;
  // Whether it is in an element with this tag.
  bool is_in(ElementAt at, std::string_view tag) const;

 private:
  std::string_view main_tree(std::uint32_t document) const;

  const Project& project_;
  const Catalog& catalog_;
  const LanguageRules* rules_;
  std::vector<std::shared_ptr<const Document>> documents_;
};

// Replaces these bytes of a value, as a program reads it, or of a text of an element.
void replace_in_value(TextEdit& edit, const Document& document, const Attribute& attribute,
                      std::size_t begin, std::size_t end, std::string_view text);

// "k" of "{k}"; nothing if it is something else.
std::optional<std::string_view> key_in_braces(std::string_view value);
// The keys in a text that has the values of entries: a Parameter::is_template. Not ${argument}.
std::vector<std::string_view> keys_in_template(std::string_view value);

}  // namespace lockstep::host

#include "tree/check/check_trees.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/audience.h"
#include "base/core/identifier.h"
#include "base/core/pre_order.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "tree/check/attributes.h"
#include "tree/check/declared_groups.h"
#include "tree/check/element_type.h"
#include "tree/check/foreign_hints.h"
#include "tree/check/named_files.h"
#include "tree/check/node_check.h"
#include "tree/check/other_tools.h"
#include "tree/check/stand_ins.h"

namespace lockstep::host {
namespace {

// How an editor finds the schema; they say nothing about the trees.
bool is_schema_attribute(std::string_view name) {
  return name == "xmlns:xsi" || name == "xsi:noNamespaceSchemaLocation";
}

// The last ones by editors, and by `lockstep test`.
bool is_read_elsewhere(std::string_view tag) {
  constexpr std::string_view kTags[] = {"arg", "include", "plugin", "TreeNodesModel", "scenario"};
  return std::ranges::find(kTags, tag) != std::end(kTags);
}

// The language whose files have this attribute of the root.
const LanguageRules* language_marked(std::string_view attribute) {
  const auto found = std::ranges::find(languages(), attribute, &LanguageRules::root_attribute);
  return found == languages().end() ? nullptr : *found;
}

std::string element_hint(std::string_view tag) {
  constexpr std::string_view kTags[] = {"BehaviorTree", "plugin",    "arg",      "include",
                                        "barrier",      "resources", "property", "scenario"};
  const std::string hint = foreign_node_hint(tag, {});
  return hint.empty() ? suggest(tag, kTags, "elements of 'root'") : hint;
}

class TreeChecker {
 public:
  TreeChecker(const Project& project, const Catalog& catalog, Diagnostics& diagnostics)
      : project_(project),
        catalog_(catalog),
        report_(project.sources, diagnostics),
        groups_(project, report_, trees_) {}

  CheckedTrees check() {
    std::size_t elements = 0, attributes = 0;
    for (const auto& document : project_.documents) {
      elements += document->elements().size();
      const Element& last = document->elements().back();
      attributes += last.first_attribute + last.attribute_count;
    }
    trees_.nodes.reserve(elements);
    trees_.values.reserve(attributes);
    for (number_ = 0; number_ < project_.documents.size(); ++number_) {
      document_ = project_.documents[number_].get();
      elements_ = document_->elements();
      check_document();
    }
    add_named_files(project_, trees_, report_);
    return std::move(trees_);
  }

 private:
  const Element& element(std::uint32_t index) const { return elements_[index]; }
  std::span<const Attribute> attributes(std::uint32_t index) const {
    return document_->attributes(index);
  }

  void check_document() {
    if (element(0).tag != "root") return;  // already reported when it was read
    if (document_ == project_.documents.front().get()) read_main();
    check_root();
    for (const std::uint32_t child : children_in(elements_, 0)) {
      const std::string_view tag = element(child).tag;
      if (tag == "BehaviorTree") {
        check_tree(child);
      } else if (const NodeType* type = catalog_.find(tag);
                 type != nullptr && type->category == NodeCategory::Group) {
        groups_.check(number_, child, *type);
      } else if (tag == "property") {
        check_property(child);
      } else if (!is_read_elsewhere(tag)) {
        if (report_.counted_only(Severity::Error)) continue;
        report_.at("unknown-element"_code, element(child).place,
                   fmt::format("unknown element '{}' in 'root'", brief(tag)), element_hint(tag));
      }
    }
  }

  void read_main() {
    trees_.main = {.place = element(0).place};
    if (const Attribute* main = find_attribute(attributes(0), "main_tree_to_execute")) {
      trees_.main->tree = main->value;
      trees_.main->tree_place = main->place;
    } else if (project_.given < project_.documents.size()) {
      read_only_tree();
    }
  }

  // Of the files that are given, whatever trees a library adds to them.
  void read_only_tree() {
    const Attribute* only = nullptr;
    int trees = 0;
    for (std::size_t i = 0; i < project_.given; ++i) {
      const Document& document = *project_.documents[i];
      const auto elements = document.elements();
      for (const std::uint32_t child : children_in(elements, 0)) {
        if (elements[child].tag != "BehaviorTree") continue;
        ++trees;
        only = document.find_attribute(child, "ID");
      }
    }
    if (trees != 1 || only == nullptr) return;
    trees_.main->tree = only->value;
    trees_.main->tree_place = only->place;
    trees_.main->is_only = true;
  }

  void check_root() const {
    bool versioned = false;
    for (const auto& [name, value, place] : attributes(0)) {
      if (name == "lockstep") {
        versioned = true;
        if (value != "1") {
          report_.at_value("unknown-version"_code, place,
                           fmt::format("version '{}' of the language is not known", brief(value)),
                           "this program reads lockstep=\"1\"");
        }
      } else if (const LanguageRules* other = language_marked(name)) {
        report_.at(
            "wrong-language"_code, place, fmt::format("this file is for {}", other->title),
            "the file that includes it is in lockstep's language; all files of a tree are in "
            "the same");
        versioned = true;
      } else if (name != "main_tree_to_execute" && !is_schema_attribute(name)) {
        report_.at("unknown-attribute"_code, place,
                   fmt::format("'root' has no attribute '{}'", brief(name)),
                   "attributes of 'root': lockstep, main_tree_to_execute");
      }
    }
    if (!versioned) {
      report_.at("missing-attribute"_code, element(0).place,
                 "'root' needs the attribute 'lockstep'",
                 "write <root lockstep=\"1\">: the version of the language");
    }
  }

  // Its text is checked later, against the expanded tree (run/loading/tree_properties.h).
  void check_property(std::uint32_t index) {
    const Place place = element(index).place;
    if (element(index).end > index + 1) {
      report_.at("unexpected-element"_code, element(index + 1).place,
                 "'property' cannot contain elements");
    }
    const Attribute* name = nullptr;
    const Attribute* text = nullptr;
    for (const Attribute& attribute : attributes(index)) {
      if (attribute.name.empty()) {
        text = &attribute;
      } else if (attribute.name == "name") {
        name = &attribute;
        check_property_name(attribute);
      } else if (attribute.name != "_description") {
        report_.at("unknown-attribute"_code, attribute.place,
                   fmt::format("'property' has no attribute '{}'", brief(attribute.name)),
                   "attributes of 'property': name");
      }
    }
    if (name == nullptr) {
      report_.at("missing-attribute"_code, place, "'property' needs the attribute 'name'",
                 "write <property name=\"…\">");
    }
    if (text == nullptr) {
      report_.at("bad-property"_code, place, "the property has no text",
                 "write it as text: <property name=\"…\">never arm.failure</property>");
    }
    const bool is_of_main = document_ == project_.documents.front().get();
    if (is_of_main && name != nullptr && text != nullptr) {
      trees_.properties.push_back({name->value, text->value, text->place});
    }
  }

  void check_property_name(const Attribute& name) {
    if (!is_identifier(name.value)) {
      return report_.at_value("bad-name"_code, name.place,
                              fmt::format("'{}' is not a name for 'property'", brief(name.value)),
                              fmt::format("such a name is {}", kIdentifierRule));
    }
    if (!project_.prefixes[number_].empty()) return;  // each copy of such a file has them
    const auto [first, is_new] = property_places_.try_emplace(name.value, name.place);
    if (is_new || report_.counted_only(Severity::Error)) return;
    report_.at_value(
        "duplicate-name"_code, name.place,
        fmt::format("a property '{}' exists already", brief(name.value)),
        fmt::format("the first is at {}", to_text(project_.sources.locate(first->second))));
  }

  void check_tree(std::uint32_t tree) {
    const Place place = element(tree).place;
    const Attribute* named = nullptr;
    for (const Attribute& attribute : attributes(tree)) {
      if (attribute.name == "ID") {
        named = &attribute;
      } else if (attribute.name != "_description") {
        report_.at("unknown-attribute"_code, attribute.place,
                   fmt::format("'BehaviorTree' has no attribute '{}'", brief(attribute.name)),
                   "attributes of 'BehaviorTree': ID");
      }
    }
    const std::string_view id = named == nullptr ? std::string_view() : named->value;
    if (id.empty()) {
      report_.at("missing-attribute"_code, place, "'BehaviorTree' needs the attribute 'ID'",
                 "write <BehaviorTree ID=\"…\">");
    } else if (id.find('/') != std::string_view::npos) {
      report_.at_value("bad-name"_code, named->place,
                       fmt::format("the ID '{}' contains '/'", brief(id)),
                       "'/' separates the names in a node's path");
    }
    const std::uint32_t root = tree + 1;
    if (root == element(tree).end) {
      report_.at("empty-tree"_code, place, fmt::format("the tree '{}' is empty", brief(id)),
                 "put one node into it");
      enter_tree(named, place);  // so that references to it are not reported
      CheckedNode nothing;
      nothing.end = count(trees_.nodes) + 1;
      trees_.nodes.push_back(nothing);
      return;
    }
    if (const std::uint32_t second = element(root).end; second != element(tree).end) {
      report_.at("several-roots"_code, element(second).place,
                 fmt::format("the tree '{}' has more than one root node", brief(id)),
                 "put them into a Sequence, a Fallback or a parallel node");
    }
    CheckedTree* const entered = enter_tree(named, place);
    tree_ = {};
    tree_.space = project_.prefixes[number_];
    tree_.first_subtree = count(trees_.subtrees);
    tree_.root = count(trees_.nodes);
    check_node(root, 0, 0);
    tree_.subtrees = count(trees_.subtrees) - tree_.first_subtree;
    if (entered != nullptr) *entered = tree_;
  }

  // Where the content of the tree at `place` is stored; null if the tree cannot be referenced.
  CheckedTree* enter_tree(const Attribute* named, Place place) {
    if (named == nullptr || named->value.empty()) return nullptr;  // reported already
    const std::string_view id = named->value;
    const auto [entry, is_new] = trees_.trees.try_emplace(id, CheckedTree{count(trees_.nodes)});
    if (is_new) {
      trees_.ids.push_back(id);
      places_.emplace(id, place);
      return &entry->second;
    }
    report_.at_value("duplicate-tree"_code, named->place,
                     fmt::format("a tree '{}' exists already", brief(id)),
                     hint_for_second_tree(project_.sources, places_.at(id), named->place));
    return nullptr;
  }

  // `path_size`: bytes of the path of its parent.
  void check_node(std::uint32_t index, std::uint32_t depth, std::uint64_t path_size) {
    const std::uint32_t self = count(trees_.nodes);
    trees_.nodes.emplace_back();
    CheckedNode node;
    node.place = element(index).place;
    const bool is_explicit = is_explicit_tag(element(index).tag);
    node.type = is_explicit ? find_explicit_type(index) : find_type(index);
    if (node.type != nullptr && node.type->category == NodeCategory::Group) {
      report_.at("not-a-node"_code, node.place,
                 fmt::format("'{}' is not a node of a tree", node.type->id),
                 "declare it in 'root', outside the trees");
      node.type = nullptr;
    }
    for ([[maybe_unused]] const auto child : children_in(elements_, index)) ++node.children;
    NodeElement element_of_node{node.place, attributes(index), is_explicit};
    std::vector<Attribute> ports;
    if (node.type != nullptr && node.type->category == NodeCategory::SubTree) {
      if (const NodeType* stand_in = stand_in_for_tree(attributes(index), catalog_)) {
        node.type = stand_in;
        std::ranges::copy_if(attributes(index), std::back_inserter(ports), [](const Attribute& it) {
          return it.name != "ID" && it.name != "_autoremap";
        });
        element_of_node.attributes = ports;
      }
    }
    if (node.type != nullptr) node.type = type_of_element(element_of_node, *node.type, report_);
    if (node.type != nullptr) {
      check_arity({elements_, index}, node, report_);
      check_content(element_of_node, self, node);
    }
    path_size += node.name.size() + 1;
    tree_.paths_size += path_size;
    tree_.depth = std::max(tree_.depth, depth + 1);
    if (node.type != nullptr && node.type->category == NodeCategory::SubTree) {
      trees_.subtrees.back().depth = depth;
      trees_.subtrees.back().path_size = path_size;
    }
    for (const std::uint32_t child : children_in(elements_, index)) {
      check_node(child, depth + 1, path_size);
    }
    node.end = count(trees_.nodes);
    trees_.nodes[self] = node;
  }

  // Checks the attributes of a node.
  void check_content(const NodeElement& element, std::uint32_t self, CheckedNode& node) {
    const bool bare = element.attributes.empty();
    const Attribute* name = bare ? nullptr : find_attribute(element.attributes, "name");
    node.name = name != nullptr ? name->value : node.type->id;
    if (node.type->category == NodeCategory::SubTree) {
      CheckedSubTree subtree{.node = self};
      check_subtree_attributes(element, report_, node, subtree, trees_);
      if (name == nullptr) {
        node.name = Project::written(subtree.id, project_.prefixes[number_]);
      }
      node.first = count(trees_.subtrees);
      trees_.subtrees.push_back(subtree);
    } else if (!bare || !node.type->parameters.empty()) {
      check_attributes(element, report_, node, layouts_, trees_);
    }
    if (!bare) keep_written(element, node, trees_);
  }

  template <class T>
  static std::uint32_t count(const std::vector<T>& all) {
    return static_cast<std::uint32_t>(all.size());
  }

  // Often the type of the node before it.
  const NodeType* find_type(std::uint32_t index) {
    const std::string_view tag = element(index).tag;
    if (last_type_ != nullptr && last_type_->id == tag) return last_type_;
    const NodeType* type = catalog_.find(tag);
    if (type == nullptr) {
      unknown(index, tag, nullptr);
    } else {
      last_type_ = type;
    }
    return type;
  }

  const NodeType* find_explicit_type(std::uint32_t index) const {
    const std::string_view tag = element(index).tag;
    const Attribute* id = find_attribute(attributes(index), "ID");
    if (id == nullptr) {
      report_.at("missing-attribute"_code, element(index).place,
                 fmt::format("'{}' needs the attribute 'ID'", tag),
                 fmt::format("write <{} ID=\"…\"/> with the id of a node", tag));
      return nullptr;
    }
    const NodeType* type = catalog_.find(id->value);
    if (type == nullptr) {
      unknown(index, id->value, id);
    } else if (tag != explicit_tag(type->category)) {
      report_.at_value(
          "wrong-category"_code, id->place,
          fmt::format("'{}' is not of the kind '{}'", id->value, tag),
          fmt::format("it is a kind of {}: write <{}>", to_string(type->category), id->value));
    }
    return type;
  }

  void unknown(std::uint32_t index, std::string_view id, const Attribute* attribute) const {
    if (report_.counted_only(Severity::Error)) return;
    std::string hint = foreign_node_hint(id, attributes(index));
    if (hint.empty()) hint = hint_for_other_tools(id, catalog_);
    if (hint.empty()) hint = did_you_mean(id, catalog_.ids());
    if (hint.empty() && trees_.trees.contains(id)) {
      hint = fmt::format("to use the tree '{0}' write <SubTree ID=\"{0}\"/>", brief(id));
    }
    if (hint.empty()) {
      hint =
          "if a plugin provides it, name that with <plugin name=\"…\"/>; `lockstep nodes` "
          "lists the built-in nodes";
      hint += worded(", and --mock runs the tree without it", "");
    }
    const std::string message = fmt::format("unknown node '{}'", brief(id));
    if (attribute == nullptr) {
      report_.at("unknown-node"_code, element(index).place, message, hint);
    } else {
      report_.at_value("unknown-node"_code, attribute->place, message, hint);
    }
  }

  const Project& project_;
  const Catalog& catalog_;
  const Reporter report_;
  CheckedTrees trees_;
  AttributeLayouts layouts_;
  CheckedTree tree_;                          // that is being checked
  std::map<std::string_view, Place> places_;  // of the trees, by ID
  std::map<std::string_view, Place> property_places_;
  DeclaredGroups groups_;
  std::uint32_t number_ = 0;  // of the document, in the project
  const Document* document_ = nullptr;
  std::span<const Element> elements_;  // of the document
  const NodeType* last_type_ = nullptr;
};

}  // namespace

CheckedTrees check_trees(const Project& project, const Catalog& catalog, Diagnostics& diagnostics) {
  return TreeChecker(project, catalog, diagnostics).check();
}

}  // namespace lockstep::host

#include <fmt/format.h>

#include <algorithm>

#include "core/suggest.h"
#include "core/wording.h"
#include "definition/attributes.h"
#include "definition/checked_tree.h"
#include "definition/foreign_nodes.h"

namespace lockstep {
namespace {

constexpr std::string_view kExplicitTags[] = {"Action", "Condition", "Control", "Decorator"};

// How an editor finds the schema; they say nothing about the trees.
bool is_schema_attribute(std::string_view name) {
  return name == "xmlns:xsi" || name == "xsi:noNamespaceSchemaLocation";
}

bool is_explicit(std::string_view tag) {
  return std::ranges::find(kExplicitTags, tag) != std::end(kExplicitTags);
}

bool matches(std::string_view tag, NodeCategory category) {
  constexpr NodeCategory kCategories[] = {NodeCategory::Action, NodeCategory::Condition,
                                          NodeCategory::Control, NodeCategory::Decorator};
  for (std::size_t i = 0; i < std::size(kExplicitTags); ++i) {
    if (kExplicitTags[i] == tag) return kCategories[i] == category;
  }
  return false;
}

std::string element_hint(std::string_view tag) {
  constexpr std::string_view kTags[] = {"BehaviorTree", "plugin", "arg", "include"};
  const std::string hint = foreign_node_hint(tag, {});
  return hint.empty() ? suggest(tag, kTags, "elements of 'root'") : hint;
}

class TreeChecker {
 public:
  TreeChecker(const Project& project, const Catalog& catalog, Diagnostics& diagnostics)
      : project_(project), catalog_(catalog), diagnostics_(diagnostics) {}

  CheckedTrees check() {
    std::size_t elements = 0;
    for (const auto& document : project_.documents) elements += document->elements().size();
    trees_.nodes.reserve(elements);
    for (document_ = 0; document_ < project_.documents.size(); ++document_) {
      elements_ = document().elements();
      check_document();
    }
    return std::move(trees_);
  }

 private:
  const Document& document() const { return *project_.documents[document_]; }
  const Element& element(std::uint32_t index) const { return elements_[index]; }

  void check_document() {
    if (element(0).tag != "root") return;  // told when it was read
    const Reporter report(document(), diagnostics_);
    check_root(report);
    for (std::uint32_t child = 1; child < element(0).end; child = element(child).end) {
      const std::string_view tag = element(child).tag;
      if (tag == "BehaviorTree") {
        check_tree(report, child);
      } else if (tag != "arg" && tag != "include" && tag != "plugin") {
        if (report.counted_only(Severity::Error)) continue;
        report.at_element(child, fmt::format("unknown element '{}' in 'root'", brief(tag)),
                          element_hint(tag));
      }
    }
  }

  void check_root(const Reporter& report) const {
    bool versioned = false;
    for (const Attribute& attribute : document().attributes(0)) {
      if (attribute.name == "lockstep") {
        versioned = true;
        if (attribute.value != "1") {
          report.at_value(
              0, "lockstep",
              fmt::format("version '{}' of the language is not known", brief(attribute.value)),
              "this program reads lockstep=\"1\"");
        }
      } else if (attribute.name == "BTCPP_format") {
        report.at_attribute(
            0, attribute.name, "files for BehaviorTree.CPP are not read yet",
            "write lockstep=\"1\" and check the tree's meaning in docs/language.md");
        versioned = true;
      } else if (attribute.name != "main_tree_to_execute" && !is_schema_attribute(attribute.name)) {
        report.at_attribute(0, attribute.name,
                            fmt::format("'root' has no attribute '{}'", brief(attribute.name)),
                            "attributes of 'root': lockstep, main_tree_to_execute");
      }
    }
    if (!versioned) {
      report.at_element(0, "'root' needs the attribute 'lockstep'",
                        "write <root lockstep=\"1\">: the version of the language");
    }
  }

  void check_tree(const Reporter& report, std::uint32_t tree) {
    std::string_view id;
    for (const Attribute& attribute : document().attributes(tree)) {
      if (attribute.name == "ID") {
        id = attribute.value;
      } else if (attribute.name != "_description") {
        report.at_attribute(
            tree, attribute.name,
            fmt::format("'BehaviorTree' has no attribute '{}'", brief(attribute.name)),
            "attributes of 'BehaviorTree': ID");
      }
    }
    if (id.empty()) {
      report.at_element(tree, "'BehaviorTree' needs the attribute 'ID'",
                        "write <BehaviorTree ID=\"…\">");
    } else if (id.find('/') != std::string_view::npos) {
      report.at_value(tree, "ID", fmt::format("the ID '{}' contains '/'", brief(id)),
                      "'/' separates the names in a node's path");
    }
    const std::uint32_t root = tree + 1;
    if (root == element(tree).end) {
      report.at_element(tree, fmt::format("the tree '{}' is empty", brief(id)),
                        "put one node into it");
      enter_tree(report, tree, id);  // so that whoever names it is not blamed
      CheckedNode nothing;
      nothing.end = count(trees_.nodes) + 1;
      trees_.nodes.push_back(nothing);
      return;
    }
    if (const std::uint32_t second = element(root).end; second != element(tree).end) {
      report.at_element(second, fmt::format("the tree '{}' has more than one root node", brief(id)),
                        "put them into a Sequence, a Fallback or a parallel node");
    }
    CheckedTree* const entered = enter_tree(report, tree, id);
    tree_ = {};
    tree_.first_reference = count(trees_.references);
    tree_.root = count(trees_.nodes);
    check_node(report, root, 0, 0);
    tree_.references = count(trees_.references) - tree_.first_reference;
    if (entered != nullptr) *entered = tree_;
  }

  // Where what is found in it belongs; null when nobody can name it.
  CheckedTree* enter_tree(const Reporter& report, std::uint32_t tree, std::string_view id) {
    if (id.empty()) return nullptr;  // reported already
    const auto [entry, is_new] = trees_.trees.try_emplace(id, CheckedTree{count(trees_.nodes)});
    if (is_new) {
      trees_.ids.push_back(id);
      places_.emplace(id, std::pair(document_, tree));
      return &entry->second;
    }
    const auto [first_document, first_element] = places_.at(id);
    const auto first = project_.documents[first_document]->locate(first_element);
    report.at_value(tree, "ID", fmt::format("a tree '{}' exists already", brief(id)),
                    fmt::format("the first is at {}:{}:{}", first.file, first.line, first.column));
    return nullptr;
  }

  // `path_size`: bytes of the path of its parent.
  void check_node(const Reporter& report, std::uint32_t index, std::uint32_t depth,
                  std::uint64_t path_size) {
    const std::uint32_t place = count(trees_.nodes);
    trees_.nodes.emplace_back();
    CheckedNode node;
    node.document = document_;
    node.element = index;
    const bool explicit_form = is_explicit(element(index).tag);
    node.type = explicit_form ? find_explicit_type(report, index) : find_type(report, index);
    for (std::uint32_t child = index + 1; child < element(index).end; child = element(child).end) {
      ++node.children;
    }
    if (node.type != nullptr) {
      const bool bare = element(index).attribute_count == 0;
      const Attribute* name = bare ? nullptr : document().find_attribute(index, "name");
      node.name = name != nullptr ? name->value : node.type->id;
      check_arity(report, node);
      if (node.type->category == NodeCategory::SubTree) {
        check_subtree_attributes(document(), report, node);
        if (name == nullptr) node.name = node.subtree;
      } else if (!bare || !node.type->parameters.empty()) {
        check_attributes(document(), report, explicit_form, node, trees_);
      }
    }
    path_size += node.name.size() + 1;
    tree_.paths_size += path_size;
    tree_.depth = std::max(tree_.depth, depth + 1);
    if (!node.subtree.empty()) trees_.references.push_back({place, depth, path_size});
    for (std::uint32_t child = index + 1; child < element(index).end; child = element(child).end) {
      check_node(report, child, depth + 1, path_size);
    }
    node.end = count(trees_.nodes);
    trees_.nodes[place] = node;
  }

  template <class T>
  static std::uint32_t count(const std::vector<T>& all) {
    return static_cast<std::uint32_t>(all.size());
  }

  // Often the type of the node before it.
  const NodeType* find_type(const Reporter& report, std::uint32_t index) {
    const std::string_view tag = element(index).tag;
    if (last_type_ != nullptr && last_type_->id == tag) return last_type_;
    const NodeType* type = catalog_.find(tag);
    if (type == nullptr) {
      unknown(report, index, tag, nullptr);
    } else {
      last_type_ = type;
    }
    return type;
  }

  const NodeType* find_explicit_type(const Reporter& report, std::uint32_t index) const {
    const std::string_view tag = element(index).tag;
    const Attribute* id = document().find_attribute(index, "ID");
    if (id == nullptr) {
      report.at_element(index, fmt::format("'{}' needs the attribute 'ID'", tag),
                        fmt::format("write <{} ID=\"…\"/> with the id of a node", tag));
      return nullptr;
    }
    const NodeType* type = catalog_.find(id->value);
    if (type == nullptr) {
      unknown(report, index, id->value, id);
    } else if (!matches(tag, type->category)) {
      report.at_value(
          index, "ID", fmt::format("'{}' is not of the kind '{}'", id->value, tag),
          fmt::format("it is a kind of {}: write <{}>", to_string(type->category), id->value));
    }
    return type;
  }

  void unknown(const Reporter& report, std::uint32_t index, std::string_view id,
               const Attribute* attribute) const {
    if (report.counted_only(Severity::Error)) return;
    std::string hint = foreign_node_hint(id, document().attributes(index));
    if (hint.empty()) hint = did_you_mean(id, catalog_.ids());
    if (hint.empty() && trees_.trees.contains(id)) {
      hint = fmt::format("to use the tree '{0}' write <SubTree ID=\"{0}\"/>", brief(id));
    }
    if (hint.empty()) {
      hint =
          "if a plugin provides it, name that with <plugin name=\"…\"/>; `lockstep nodes` "
          "lists the built-in nodes";
    }
    const std::string message = fmt::format("unknown node '{}'", brief(id));
    if (attribute == nullptr) {
      report.at_element(index, message, hint);
    } else {
      report.at_value(index, attribute->name, message, hint);
    }
  }

  void check_arity(const Reporter& report, const CheckedNode& node) const {
    const NodeType& type = *node.type;
    if (type.category == NodeCategory::SubTree) {
      if (node.children == 0) return;
      report.at_element(node.element + 1, "'SubTree' has no children of its own",
                        "its tree is the BehaviorTree that its ID names");
    } else if (node.children < type.arity.min) {
      report.at_element(node.element,
                        fmt::format("'{}' needs {}", type.id,
                                    type.arity.max == 1 ? "exactly one child" : "a child"),
                        fmt::format("it is a {}: put a node into it", to_string(type.category)));
    } else if (node.children > type.arity.max) {
      // The first child that is one too many.
      std::uint32_t extra = node.element + 1;
      for (std::uint32_t i = 0; i < type.arity.max; ++i) extra = element(extra).end;
      report.at_element(extra,
                        type.arity.max == 0 ? fmt::format("'{}' cannot have children", type.id)
                                            : fmt::format("'{}' has more than one child", type.id),
                        type.arity.max == 0
                            ? fmt::format("it is a leaf ({})", to_string(type.category))
                            : "put the children into a Sequence, a Fallback or a "
                              "parallel node");
    }
  }

  const Project& project_;
  const Catalog& catalog_;
  Diagnostics& diagnostics_;
  CheckedTrees trees_;
  CheckedTree tree_;  // that is being checked
  std::map<std::string_view, std::pair<std::uint32_t, std::uint32_t>> places_;
  std::uint32_t document_ = 0;
  std::span<const Element> elements_;  // of the document
  const NodeType* last_type_ = nullptr;
};

}  // namespace

CheckedTrees check_trees(const Project& project, const Catalog& catalog, Diagnostics& diagnostics) {
  return TreeChecker(project, catalog, diagnostics).check();
}

}  // namespace lockstep

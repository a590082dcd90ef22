#include "dialect/btcpp/read_trees.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/audience.h"
#include "base/core/pre_order.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "dialect/btcpp/attributes.h"
#include "dialect/btcpp/rules.h"
#include "dialect/btcpp/version_3.h"
#include "tree/check/declared_groups.h"
#include "tree/check/document_order.h"
#include "tree/check/element_type.h"
#include "tree/check/foreign_hints.h"
#include "tree/check/named_files.h"
#include "tree/check/node_check.h"
#include "tree/check/other_tools.h"
#include "tree/check/stand_ins.h"

namespace lockstep::host::btcpp {
namespace {

// The only tree of a file needs no ID.
constexpr std::string_view kNoId = "BehaviorTree";

constexpr std::uint32_t kMaxLevels = 256;  // of elements below BehaviorTree

class TreeReader {
 public:
  TreeReader(const Project& project, const Catalog& catalog, const Models& models,
             Diagnostics& diagnostics)
      : project_(project),
        catalog_(catalog),
        models_(models),
        report_(project.sources, diagnostics),
        groups_(project, report_, trees_) {}

  CheckedTrees read() {
    trees_.rules = &kRules;
    trees_.words = catalog_.words();
    for (const std::uint32_t document : document_order(project_)) {
      number_ = document;
      document_ = project_.documents[document].get();
      elements_ = document_->elements();
      read_document();
    }
    for (const auto& [id, tree] : trees_.trees) trees_.ids.push_back(id);
    add_named_files(project_, trees_, report_);
    return std::move(trees_);
  }

 private:
  const Element& element(std::uint32_t index) const { return elements_[index]; }
  std::span<const Attribute> attributes(std::uint32_t index) const {
    return document_->attributes(index);
  }

  void read_document() {
    if (element(0).tag != "root") return;  // already reported when it was read
    const bool is_main = document_ == project_.documents.front().get();
    read_root(is_main);
    trees_here_ = static_cast<std::uint32_t>(std::ranges::count(
        children_of_root(), "BehaviorTree", [&](auto child) { return element(child).tag; }));
    if (is_main) read_main();
    for (const std::uint32_t child : children_of_root()) read_child(child);
  }

  std::vector<std::uint32_t> children_of_root() const {
    std::vector<std::uint32_t> children;
    for (const std::uint32_t child : children_in(elements_, 0)) children.push_back(child);
    return children;
  }

  void read_child(std::uint32_t child) {
    constexpr std::string_view kKnown[] = {"BehaviorTree", "include", "TreeNodesModel", "plugin",
                                           "arg",          "barrier", "resources",      "team"};
    const std::string_view tag = element(child).tag;
    if (tag == "BehaviorTree") return read_tree(child);
    const NodeType* const type = catalog_.find(tag);
    if (type != nullptr && type->category == NodeCategory::Group) {
      return groups_.check(number_, child, *type);
    }
    if (std::ranges::find(kKnown, tag) != std::end(kKnown)) return;
    if (report_.counted_only(Severity::Warning)) return;
    report_.at("unknown-element"_code, element(child).place,
               fmt::format("'root' ignores the element '{}'", brief(tag)),
               suggest(tag, kKnown, "elements of 'root'"), Severity::Warning);
  }

  void read_root(bool is_main) {
    const Attribute* format = find_attribute(attributes(0), "BTCPP_format");
    is_version_3_ = format == nullptr || format->value != "4";
    if (const Attribute* ours = find_attribute(attributes(0), "lockstep")) {
      report_.at(
          "wrong-language"_code, ours->place,
          is_main ? "this file declares two languages" : "this file is in lockstep's language",
          is_main ? "with BTCPP_format it is for BehaviorTree.CPP: leave out 'lockstep'"
                  : "the file that includes it is for BehaviorTree.CPP; all files of a tree "
                    "are in the same language");
    } else if (format == nullptr) {
      report_.at("wrong-language"_code, element(0).place,
                 "without 'BTCPP_format' this is read as a file of version 3",
                 "write <root BTCPP_format=\"4\">, or lockstep=\"1\" for lockstep's own language",
                 Severity::Warning);
    } else if (format->value != "4" && format->value != "3") {
      report_.at_value("unknown-version"_code, format->place,
                       fmt::format("the format '{}' is not known", brief(format->value)),
                       "this program reads BTCPP_format=\"4\"");
    }
  }

  void read_main() {
    trees_.main = {.place = element(0).place};
    const Attribute* main = find_attribute(attributes(0), "main_tree_to_execute");
    if (main != nullptr && !main->value.empty()) {
      trees_.main->tree = main->value;
      trees_.main->tree_place = main->place;
    } else if (trees_here_ == 1) {
      for (const std::uint32_t child : children_of_root()) {
        if (element(child).tag == "BehaviorTree") {
          trees_.main->tree = id_of(child);
          trees_.main->is_only = true;
          trees_.main->tree_place = element(child).place;
        }
      }
    }
  }

  std::string_view id_of(std::uint32_t tree) {
    const Attribute* named = find_attribute(attributes(tree), "ID");
    if (named != nullptr) return named->value;
    if (trees_here_ != 1) return {};
    return prefix().empty() ? kNoId
                            : trees_.texts.emplace_back(fmt::format("{}{}", prefix(), kNoId));
  }

  const std::string& prefix() const { return project_.prefixes[number_]; }

  void read_tree(std::uint32_t tree) {
    const std::string_view id = id_of(tree);
    const Place place = element(tree).place;
    if (id.empty()) {
      report_.at("missing-attribute"_code, place, "'BehaviorTree' needs the attribute 'ID'",
                 "write <BehaviorTree ID=\"…\">");
    } else if (catalog_.find(id) != nullptr) {
      report_.at_value("bad-name"_code, find_attribute(attributes(tree), "ID")->place,
                       fmt::format("a tree cannot be called '{}', as a node is", brief(id)));
    }
    warn_of_attributes(tree);
    const std::uint32_t root = tree + 1;
    tree_ = {};
    tree_.space = prefix();
    tree_.first_subtree = count(trees_.subtrees);
    tree_.root = count(trees_.nodes);
    if (root == element(tree).end) {
      report_.at("empty-tree"_code, place, fmt::format("the tree '{}' is empty", brief(id)),
                 "put one node into it");
      CheckedNode nothing;
      nothing.end = count(trees_.nodes) + 1;
      trees_.nodes.push_back(nothing);
    } else {
      if (const std::uint32_t second = element(root).end; second != element(tree).end) {
        report_.at("several-roots"_code, element(second).place,
                   fmt::format("the tree '{}' has more than one root node", brief(id)),
                   "put them into a Sequence, a Fallback or a parallel node");
      }
      read_node(root, 0, 0);
    }
    tree_.subtrees = count(trees_.subtrees) - tree_.first_subtree;
    if (!id.empty()) enter_tree(id, place);
  }

  // It has an ID and marks of editors. What else is there has a meaning elsewhere.
  void warn_of_attributes(std::uint32_t tree) const {
    for (const Attribute& it : attributes(tree)) {
      const bool is_mark =
          it.name.starts_with('_') && !hook_named(it.name, kRules) && it.name != "_autoremap";
      const bool is_foreign = it.name.find(':') != it.name.npos;  // of another namespace
      if (it.name == "ID" || is_mark || is_foreign) continue;
      if (report_.counted_only(Severity::Warning)) continue;
      report_.at(
          "ignored-attribute"_code, it.place,
          fmt::format("'BehaviorTree' ignores the attribute '{}'", brief(it.name)),
          it.name.starts_with('_')
              ? "write it at the first node of the tree, or at each SubTree that uses the tree"
              : "a default of a port belongs into TreeNodesModel: <SubTree ID=\"…\">"
                "<input_port name=\"…\" default=\"…\"/></SubTree>",
          Severity::Warning);
    }
  }

  // Whether a document includes another one, itself or by others.
  bool includes(std::uint32_t document, std::uint32_t other) const {
    std::vector<bool> seen(project_.documents.size());
    std::vector<std::uint32_t> open{document};
    while (!open.empty()) {
      const std::uint32_t it = open.back();
      open.pop_back();
      if (it == other) return true;
      if (seen[it]) continue;
      seen[it] = true;
      open.insert(open.end(), project_.includes[it].begin(), project_.includes[it].end());
    }
    return false;
  }

  // A later one replaces an earlier one of its file, and of a file that it includes.
  void enter_tree(std::string_view id, Place place) {
    const auto [first, is_new] = places_.try_emplace(id, place);
    const auto [document, unused] = documents_.try_emplace(id, number_);
    if (!is_new && !report_.counted_only(Severity::Error) && !includes(number_, document->second)) {
      report_.at("duplicate-tree"_code, place, fmt::format("a tree '{}' exists already", brief(id)),
                 hint_for_second_tree(project_.sources, first->second, place));
      return;
    }
    trees_.trees[id] = tree_;
    document->second = number_;
    if (is_new) return;
    report_.at("duplicate-tree"_code, place,
               fmt::format("this tree '{}' replaces another one", brief(id)),
               fmt::format("the other one is at {}",
                           to_text(project_.sources.locate(std::exchange(first->second, place)))),
               Severity::Warning);
  }

  // `path_size`: bytes of the path of its parent.
  void read_node(std::uint32_t index, std::uint32_t depth, std::uint64_t path_size) {
    const std::uint32_t self = count(trees_.nodes);
    trees_.nodes.emplace_back();
    CheckedNode node;
    node.place = element(index).place;
    for ([[maybe_unused]] const auto child : children_in(elements_, index)) ++node.children;
    const bool is_explicit = is_explicit_tag(element(index).tag);
    node.type = is_explicit ? find_explicit_type(index) : find_compact_type(index);
    if (node.type != nullptr) {
      check_arity({elements_, index}, node, report_);
      NodeElement element{node.place, attributes(index), is_explicit};
      std::vector<Attribute> since_4;
      if (is_version_3_) {
        since_4 = attributes_since_4(elements_[index].tag, element.attributes, *node.type, report_);
        element.attributes = since_4;
      }
      if (is_subtree(node)) {
        const NodeType* stand_in = stand_in_for_tree(element.attributes, catalog_);
        if (stand_in != nullptr) node.type = stand_in;
      }
      node.type = type_of_element(element, *node.type, report_);
      if (node.type != nullptr) read_content(element, self, node);
    }
    if (depth == kMaxLevels) {
      report_.at("too-deep"_code, node.place,
                 fmt::format("elements are nested deeper than {} levels", kMaxLevels));
    }
    path_size += node.name.size() + 1;
    tree_.paths_size += path_size;
    tree_.depth = std::max(tree_.depth, depth + 1);
    if (is_subtree(node)) {
      trees_.subtrees.back().depth = depth;
      trees_.subtrees.back().path_size = path_size;
    }
    for (const std::uint32_t child : children_in(elements_, index)) {
      read_node(child, depth + 1, path_size);
    }
    node.end = count(trees_.nodes);
    trees_.nodes[self] = node;
  }

  static bool is_subtree(const CheckedNode& node) {
    return node.type != nullptr && node.type->category == NodeCategory::SubTree;
  }

  // Reads the attributes of a node.
  void read_content(const NodeElement& element, std::uint32_t self, CheckedNode& node) {
    const Attribute* name = find_attribute(element.attributes, "name");
    const bool is_named = name != nullptr && !name->value.empty();
    node.name = is_named ? in_path(name->value) : node.type->id;
    std::vector<Attribute> defaults;
    if (is_subtree(node)) {
      CheckedSubTree subtree{.node = self};
      defaults = read_subtree_attributes(element, models_, report_, node, subtree, trees_);
      if (!is_named) node.name = in_path(Project::written(subtree.id, prefix()));
      node.first = count(trees_.subtrees);
      trees_.subtrees.push_back(subtree);
    } else {
      read_attributes(element, report_, node, trees_);
    }
    if (defaults.empty()) return keep_written(element, node, trees_);
    // The tree means these, too: drawings and differences have them.
    defaults.insert(defaults.begin(), element.attributes.begin(), element.attributes.end());
    keep_written({element.place, defaults, element.is_explicit}, node, trees_);
  }

  // '/' separates the names in a path.
  std::string_view in_path(std::string_view name) {
    if (name.find('/') == std::string_view::npos) return name;
    std::string& text = trees_.texts.emplace_back();
    for (const char c : name) c == '/' ? text += "%2F" : text += c;
    return text;
  }

  template <class T>
  static std::uint32_t count(const std::vector<T>& all) {
    return static_cast<std::uint32_t>(all.size());
  }

  const NodeType* find_type(std::string_view id) const {
    const NodeType* type = catalog_.find(id);
    return type == nullptr && is_version_3_ ? catalog_.find(node_since_4(id)) : type;
  }

  const NodeType* find_compact_type(std::uint32_t index) const {
    const std::string_view tag = element(index).tag;
    const NodeType* type = find_type(tag);
    if (type == nullptr) {
      unknown(index, tag, nullptr);
    } else if (const Attribute* id = find_attribute(attributes(index), "ID");
               id != nullptr && type->category != NodeCategory::SubTree) {
      report_.at("unknown-attribute"_code, id->place,
                 fmt::format("'{}' cannot have an ID", brief(tag)),
                 fmt::format("write name=\"{}\", or <{} ID=\"{}\">", brief(id->value),
                             explicit_tag(type->category), brief(tag)));
    }
    return type;
  }

  const NodeType* find_explicit_type(std::uint32_t index) const {
    const std::string_view tag = element(index).tag;
    const Attribute* id = find_attribute(attributes(index), "ID");
    if (id == nullptr || id->value.empty()) {
      report_.at("missing-attribute"_code, element(index).place,
                 fmt::format("'{}' needs the attribute 'ID'", tag),
                 fmt::format("write <{} ID=\"…\"/> with the ID of a node", tag));
      return nullptr;
    }
    const NodeType* type = find_type(id->value);
    if (type == nullptr) {
      unknown(index, id->value, id);
    } else if (tag != explicit_tag(type->category)) {
      report_.at_value("wrong-category"_code, id->place,
                       fmt::format("'{}' is not of the kind '{}'", brief(id->value), tag),
                       fmt::format("it is a kind of {}: write <{}>", to_string(type->category),
                                   explicit_tag(type->category)),
                       Severity::Warning);
    }
    return type;
  }

  void unknown(std::uint32_t index, std::string_view id, const Attribute* attribute) const {
    if (report_.counted_only(Severity::Error)) return;
    const std::string hint = hint_for_unknown(id);
    const std::string message = fmt::format("unknown node '{}'", brief(id));
    if (attribute == nullptr) {
      report_.at("unknown-node"_code, element(index).place, message, hint);
    } else {
      report_.at_value("unknown-node"_code, attribute->place, message, hint);
    }
  }

  std::string hint_for_unknown(std::string_view id) const {
    if (const auto since = node_since_4(id); !since.empty()) {
      return fmt::format("since version 4 it is called '{}'", since);
    }
    if (const auto gone = hint_for_gone(id); !gone.empty()) return std::string(gone);
    if (is_tree(id))
      return fmt::format("to use the tree '{0}' write <SubTree ID=\"{0}\"/>", brief(id));
    std::string hint = hint_of_plugin(id);
    if (hint.empty()) hint = hint_for_other_tools(id, catalog_);
    if (hint.empty()) hint = did_you_mean(id, catalog_.ids());
    if (!hint.empty()) return hint;
    return fmt::format("if a plugin provides it, {}, or name it with <plugin name=\"…\"/>",
                       worded("give that with --plugin", "add that to the project")) +
           worded("; --mock runs the tree without it", "");
  }

  bool is_tree(std::string_view id) const {
    return std::ranges::any_of(project_.documents, [&](const auto& document) {
      const auto elements = document->elements();
      for (const std::uint32_t child : children_in(elements, 0)) {
        const Attribute* named = document->find_attribute(child, "ID");
        const bool is_one = elements[child].tag == "BehaviorTree";
        if (is_one && named != nullptr && named->value == id) return true;
      }
      return false;
    });
  }

  const Project& project_;
  const Catalog& catalog_;
  const Models& models_;
  const Reporter report_;
  CheckedTrees trees_;
  DeclaredGroups groups_;
  CheckedTree tree_;                                     // that is being read
  std::map<std::string_view, Place> places_;             // of the trees, by ID
  std::map<std::string_view, std::uint32_t> documents_;  // of each of them
  std::uint32_t number_ = 0;                             // of the document, in the project
  const Document* document_ = nullptr;
  std::span<const Element> elements_;  // of the document
  bool is_version_3_ = false;          // or older
  std::uint32_t trees_here_ = 0;       // how many BehaviorTrees it has
};

}  // namespace

CheckedTrees read_trees(const Project& project, const Catalog& catalog, const Models& models,
                        Diagnostics& diagnostics) {
  return TreeReader(project, catalog, models, diagnostics).read();
}

}  // namespace lockstep::host::btcpp

#include "groot/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "base/core/identifier.h"
#include "describe/node_reference.h"
#include "describe/xsd.h"
#include "dialect/btcpp/pairs.h"
#include "dialect/btcpp/rules.h"
#include "groot/statuses.h"
#include "run/shape_of.h"
#include "tree/check/node_check.h"

namespace lockstep::host {
namespace {

using btcpp::AttributePair;
using btcpp::NodePair;

class Writer {
 public:
  Writer(const Definition& definition, std::span<const GrootSubtree> subtrees)
      : definition_(definition), subtrees_(subtrees) {
    for (const NodeType* type : built_in_types(btcpp::kRules)) theirs_.emplace(type->id, type);
    for (const GrootSubtree& it : subtrees.subspan(1)) by_node_.emplace(it.node, &it);
  }

  std::string write() {
    text_ = "<root BTCPP_format=\"4\">\n";
    for (const GrootSubtree& it : subtrees_) add_tree(it);
    std::vector<const NodeType*> models;
    for (const auto& [id, type] : models_) models.push_back(type);
    return std::move(text_.append(tree_nodes_model(models)).append("</root>\n"));
  }

 private:
  void add_tree(const GrootSubtree& tree) {
    text_ += "<BehaviorTree";
    add("ID", tree.id);
    add("_fullpath", tree.path);
    text_ += ">\n";
    for_each_node(definition_, tree, [&](std::uint32_t node) {
      close_until(node);
      add_node(node);
    });
    close_until(definition_.nodes[tree.root].end);
    text_ += "</BehaviorTree>\n";
  }

  struct Open {
    std::uint32_t end;  // one past the last descendant
    std::string tag;
  };

  void close_until(std::uint32_t node) {
    for (; !open_.empty() && open_.back().end <= node; open_.pop_back()) {
      text_ += fmt::format("</{}>\n", open_.back().tag);
    }
  }

  void add_node(std::uint32_t index) {
    const DefinitionNode& node = definition_.nodes[index];
    const bool is_subtree = node.type->category == NodeCategory::SubTree;
    const NodePair* pair = is_ours() ? pair_of(node) : nullptr;
    const std::string_view id = pair != nullptr ? pair->theirs : node.type->id;
    const std::string tag(is_identifier(id) ? id : explicit_tag(node.type->category));
    text_ += '<' + tag;
    if (is_subtree) {
      add("ID", written_value(definition_, node, "ID"));
      add("_fullpath", by_node_.at(index)->path);
    } else {
      keep_model(id, *node.type, pair != nullptr || !is_ours());
      if (tag != id) add("ID", id);
      add("name", node.name);
    }
    add("_uid", fmt::format("{}", groot_uid(index)));
    add_attributes(node, pair);
    const bool is_leaf = is_subtree || node.end == index + 1;
    text_ += is_leaf ? "/>\n" : ">\n";
    if (!is_leaf) open_.push_back({node.end, tag});
  }

  bool is_ours() const { return definition_.rules == &kLockstepRules; }

  // Null also if a value of the node cannot be said there.
  const NodePair* pair_of(const DefinitionNode& node) const {
    const auto written = definition_.attributes(node);
    const auto given = [&](std::string_view name) -> std::optional<std::string_view> {
      const auto found = std::ranges::find(written, name, &WrittenAttribute::name);
      return found == written.end() ? std::nullopt : std::optional(found->value);
    };
    const NodePair* pair = btcpp::find_pair(btcpp::Side::Ours, node.type->id, given);
    const bool can_be_said =
        pair != nullptr && std::ranges::all_of(written, [&](const WrittenAttribute& it) {
          const AttributePair* other = attribute_pair(*pair, it.name);
          return other == nullptr || btcpp::value_there(other->conversion, it.value);
        });
    return can_be_said ? pair : nullptr;
  }

  static const AttributePair* attribute_pair(const NodePair& pair, std::string_view ours) {
    const auto found = std::ranges::find(pair.attributes, ours, &AttributePair::ours);
    return found == pair.attributes.end() ? nullptr : &*found;
  }

  // Those of the library are described as it has them.
  void keep_model(std::string_view id, const NodeType& type, bool is_theirs) {
    const auto known = is_theirs ? theirs_.find(id) : theirs_.end();
    models_.emplace(id, known != theirs_.end() ? known->second : &type);
  }

  void add_attributes(const DefinitionNode& node, const NodePair* pair) {
    if (pair != nullptr && !pair->in_theirs.name.empty() && !pair->in_theirs.is_default) {
      add(pair->in_theirs.name, pair->in_theirs.value);
    }
    if (pair != nullptr) add_rounds(node, *pair);
    for (const WrittenAttribute& it : definition_.attributes(node)) {
      const auto hook = hook_named(it.name, *definition_.rules);
      if (hook) {
        add(attribute_of(*hook, btcpp::kRules), it.value);
      } else if (it.name != "ID" && !it.name.starts_with('_')) {
        add_parameter(it, pair);
      }
    }
  }

  // Without a number, a node of ours goes on for ever.
  void add_rounds(const DefinitionNode& node, const NodePair& pair) {
    for (const AttributePair& it : pair.attributes) {
      const bool is_given = !written_value(definition_, node, it.ours).empty();
      if (it.conversion == btcpp::Conversions::Rounds && !is_given) add(it.theirs, "-1");
    }
  }

  void add_parameter(const WrittenAttribute& it, const NodePair* pair) {
    if (pair == nullptr) return add(it.name, it.value);
    if (pair->in_ours.name == it.name) return;
    const AttributePair* other = attribute_pair(*pair, it.name);
    if (other == nullptr) return add(it.name, it.value);
    const std::string value = *btcpp::value_there(other->conversion, it.value);
    if (!value.empty()) add(other->theirs, value);
  }

  void add(std::string_view name, std::string_view value) {
    text_ += fmt::format(" {}=\"{}\"", name, xsd_escaped(value));
  }

  const Definition& definition_;
  std::span<const GrootSubtree> subtrees_;
  std::map<std::string_view, const NodeType*> theirs_;
  std::map<std::uint32_t, const GrootSubtree*> by_node_;
  std::map<std::string_view, const NodeType*> models_;
  std::vector<Open> open_;
  std::string text_;
};

}  // namespace

std::string groot_document(const Definition& definition, std::span<const GrootSubtree> subtrees) {
  return Writer(definition, subtrees).write();
}

}  // namespace lockstep::host

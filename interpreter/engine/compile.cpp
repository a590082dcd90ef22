#include "engine/compile.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "engine/nodes/kinds.h"

namespace lockstep {
namespace {

const NodeKind* kind_of(const NodeType& type) {
  if (type.binding != nullptr) {
    return type.category == NodeCategory::Condition ? &kPluginCondition : &kPluginAction;
  }
  static const auto by_type = [] {
    std::unordered_map<const NodeType*, const NodeKind*> map;
    for (const NodeKind* kind : built_in_kinds()) map.emplace(&kind->type, kind);
    return map;
  }();
  return by_type.at(&type);
}

class Compiler {
 public:
  explicit Compiler(const Definition& definition) : definition_(definition) {}

  Tree compile() {
    tree_.id = definition_.id;
    tree_.nodes.reserve(definition_.nodes.size());
    for (const DefinitionNode& node : definition_.nodes) add(node);
    for (const BlackboardEntry& entry : definition_.entries) {
      tree_.slots.push_back({entry.name, entry.type, entry.initial});
    }
    add_labels();
    return std::move(tree_);
  }

 private:
  void add(const DefinitionNode& from) {
    Node node{.kind = kind_of(*from.type),
              .end = from.end,
              .children = from.children,
              .params = 0,
              .state = static_cast<std::uint32_t>(tree_.state_size)};
    node.params = from.type->binding != nullptr ? add_leaf(from) : add_parameters(from);
    const std::size_t size =
        node.kind->state_size + std::size_t{node.kind->state_per_child} * node.children;
    tree_.state_size += (size + 7) / 8 * 8;
    tree_.nodes.push_back(node);
  }

  std::uint32_t add_leaf(const DefinitionNode& from) {
    const auto index = static_cast<std::uint32_t>(tree_.leaves.size());
    tree_.leaves.push_back({.node = static_cast<NodeIndex>(tree_.nodes.size()),
                            .type = from.type,
                            .first_port = static_cast<std::uint32_t>(tree_.ports.size())});
    for (std::size_t i = 0; i < from.type->parameters.size(); ++i) {
      const Port& port = definition_.ports[from.first + i];
      PortBinding binding{.slot = port.entry, .constant = PortBinding::kUnbound};
      if (port.value != Port::kNone) binding.constant = add_constant(port.value);
      tree_.ports.push_back(binding);
    }
    return index;
  }

  // Subtrees that are used often share their constants.
  std::uint32_t add_constant(std::uint32_t value) {
    const auto next = static_cast<std::uint32_t>(tree_.constants.size());
    const auto [entry, is_new] = constants_.try_emplace(value, next);
    if (is_new) tree_.constants.push_back(definition_.values[value]);
    return entry->second;
  }

  std::uint32_t add_parameters(const DefinitionNode& from) {
    if (from.type->parameters.empty()) return 0;
    const auto next = static_cast<std::uint32_t>(tree_.cells.size());
    const auto [entry, is_new] = cells_.try_emplace(from.first, next);
    if (!is_new) return entry->second;
    for (std::size_t i = 0; i < from.type->parameters.size(); ++i) {
      tree_.cells.push_back(cell(from.type->parameters[i], definition_.values[from.first + i]));
    }
    return next;
  }

  Cell cell(const Parameter& parameter, const Value& value) {
    Cell cell{.integer = 0};
    if (const auto* flag = std::get_if<bool>(&value)) cell.boolean = *flag;
    if (const auto* integer = std::get_if<std::int64_t>(&value)) cell.integer = *integer;
    if (const auto* number = std::get_if<double>(&value)) cell.number = *number;
    if (const auto* word = std::get_if<std::string>(&value)) {
      cell.integer = std::ranges::find(parameter.choices, *word) - parameter.choices.begin();
    }
    if (const auto* list = std::get_if<std::vector<double>>(&value)) {
      cell.list = {static_cast<std::uint32_t>(tree_.numbers.size()),
                   static_cast<std::uint32_t>(list->size())};
      tree_.numbers.insert(tree_.numbers.end(), list->begin(), list->end());
    }
    return cell;
  }

  void add_labels() {
    tree_.labels.reserve(definition_.nodes.size());
    for (const DefinitionNode& node : definition_.nodes) {
      std::string name(node.name);
      tree_.labels.push_back({name, name, node.type, node.parent});
    }
    for (NodeIndex node = 0; node < tree_.nodes.size(); ++node) {
      if (tree_.nodes[node].children > 1) make_segments_unique(node);
    }
  }

  // The second child called "arm" becomes "arm#2", or the next number that is free.
  void make_segments_unique(NodeIndex parent) {
    std::unordered_set<std::string> used;
    std::unordered_map<std::string, std::uint32_t> last;
    const NodeIndex end = tree_.nodes[parent].end;
    for (NodeIndex child = parent + 1; child < end; child = tree_.nodes[child].end) {
      NodeLabel& label = tree_.labels[child];
      std::uint32_t& number = last.try_emplace(label.name, 1).first->second;
      while (!used.insert(label.segment).second) {
        label.segment = label.name + "#" + std::to_string(++number);
      }
    }
  }

  const Definition& definition_;
  Tree tree_;
  std::unordered_map<std::uint32_t, std::uint32_t> constants_;
  std::unordered_map<std::uint32_t, std::uint32_t> cells_;
};

}  // namespace

Tree compile(const Definition& definition) {
  return Compiler(definition).compile();
}

}  // namespace lockstep

#include "run/shape_of.h"

#include <algorithm>

#include "base/core/parameter_value.h"
#include "engine/moments.h"
#include "engine/resources.h"
#include "engine/writers.h"
#include "language/expression/expression.h"

namespace lockstep::host {
namespace {

// Whether measures compare the progress of the children.
bool is_measured(const ShapeNode& node) {
  return node.latches || compares_progress(node.synchronization);
}

void add_members(const Tree& tree, Shape& shape) {
  for (const Member& member : tree.members) {
    if (!is_pool(tree, member.group)) continue;
    ShapeNode& user = shape.nodes[member.node];
    const auto gates = tree.gates_of(member);
    user.gates.assign(gates.begin(), gates.end());
    user.keeps_resources = resources::on_change(tree, member.node) != resources::OnChange::Release;
    shape.nodes[member.group].first_wins = resources::first_wins(tree, member.group);
  }
}

// A condition by a script: Check, ScriptCondition, WaitUntil.
void add_condition(const Tree& tree, NodeIndex index, ShapeNode& node) {
  const NodeType& type = *tree.labels[index].type;
  const bool is_built_in = type.plugin.empty() && type.mock == nullptr && !type.reads_ports;
  const auto code = std::ranges::find(type.parameters, "code", &Parameter::name);
  if (!is_built_in || code == type.parameters.end() || !code->is_script) return;
  if (type.category != NodeCategory::Condition && !type.can_run) return;  // a Script
  const auto place = static_cast<std::size_t>(code - type.parameters.begin());
  const auto script =
      static_cast<std::size_t>(tree.cells[tree.nodes[index].params + place].integer);
  if (script >= tree.scripts.size() || !tree.scripts[script].code) return;
  node.condition = tree.scripts[script].code->text();
  for (const std::uint32_t slot : tree.scripts[script].slots) {
    node.reads.push_back(tree.slots[slot].name);
  }
}

// The ports and parameters of the nodes, as they are after loading: "0.5", "{goal}". A built-in
// node has those that differ from the default.
class Ports {
 public:
  Ports(const Tree& tree, Shape& shape) : tree_(tree), shape_(shape), found_(tree.nodes.size()) {}

  void add() {
    for (const LeafNode& leaf : tree_.leaves) add_bindings(leaf.node, *leaf.type, leaf.first_port);
    for (const BoundNode& bound : tree_.bound)
      add_bindings(bound.node, bound.kind->type, bound.first_port);
    for (NodeIndex node = 0; node < tree_.nodes.size(); ++node) {
      add_built_in(node);
      if (found_[node].empty()) continue;
      shape_.nodes[node].ports = std::make_shared<const Texts>(std::move(found_[node]));
    }
  }

 private:
  using Texts = std::map<std::string, std::string, std::less<>>;

  static constexpr std::size_t kMost = 256;  // bytes

  void add(NodeIndex node, const Parameter& port, std::string text) {
    if (text.size() <= kMost) found_[node].emplace(port.name, std::move(text));
  }

  void add_bindings(NodeIndex node, const NodeType& type, std::uint32_t first) {
    for (std::size_t i = 0; i < type.parameters.size(); ++i) {
      const PortBinding& it = tree_.ports[first + i];
      if (it.slot != PortBinding::kUnbound) {
        add(node, type.parameters[i], "{" + tree_.slots[it.slot].name + "}");
      } else if (it.constant != PortBinding::kUnbound) {
        const Value& value = tree_.constants[it.constant];
        const bool has_text =
            !std::holds_alternative<NoValue>(value) && !std::holds_alternative<Object>(value);
        if (has_text) add(node, type.parameters[i], to_text(value));
      }
    }
  }

  void add_built_in(NodeIndex node) {
    const NodeType& type = *tree_.labels[node].type;
    const std::uint32_t first = tree_.nodes[node].params;
    const bool is_mock = type.mock != nullptr, is_leaf = type.leaf != nullptr;
    const bool has_bindings =
        is_mock ? !type.mock->outputs.empty() : !is_leaf && type.reads_ports;  // as it is compiled
    if (has_bindings) return add_bindings(node, type, first);
    // No cells, or it is bound.
    if (is_mock || is_leaf || !found_[node].empty()) return;
    for (std::size_t i = 0; i < type.parameters.size(); ++i) {
      const Parameter& parameter = type.parameters[i];
      const std::string text = text_of(parameter, tree_.cells[first + i]);
      const bool is_default = parameter.default_text && text == *parameter.default_text;
      if (!text.empty() && !is_default) add(node, parameter, text);
    }
  }

  // "" where it is absent.
  std::string text_of(const Parameter& parameter, const Cell& cell) const {
    if (parameter.is_script) return script_text(static_cast<std::size_t>(cell.integer));
    switch (parameter.type) {
      case ValueType::Bool:
        return to_text(Value(cell.boolean));
      case ValueType::Int:
        return is_absent(parameter, cell) ? "" : to_text(Value(cell.integer));
      case ValueType::Double:
        return is_absent(parameter, cell) ? "" : to_text(Value(cell.number));
      case ValueType::String: {
        const auto place = static_cast<std::size_t>(cell.integer);
        return place < parameter.choices.size() ? std::string(parameter.choices[place]) : "";
      }
      case ValueType::DoubleList:
        return to_text(
            Value(std::vector<double>(tree_.numbers.begin() + cell.list.first,
                                      tree_.numbers.begin() + cell.list.first + cell.list.count)));
      default:
        return "";
    }
  }
  // The cell of an absent number is 0.
  static bool is_absent(const Parameter& parameter, const Cell& cell) {
    return !parameter.required && cell.integer == 0;
  }
  std::string script_text(std::size_t script) const {
    const bool has_code = script < tree_.scripts.size() && tree_.scripts[script].code;
    return has_code ? std::string(tree_.scripts[script].code->text()) : "";
  }

  const Tree& tree_;
  Shape& shape_;
  std::vector<Texts> found_;  // by index
};
// A constant parameter, in its cell; null: it is absent, or an entry gives it.
const Cell* constant_cell(const Tree& tree, NodeIndex index, std::string_view name) {
  const NodeType& type = *tree.labels[index].type;
  const auto place = static_cast<std::size_t>(
      std::ranges::find(type.parameters, name, &Parameter::name) - type.parameters.begin());
  if (!type.parameters[place].constant && tree.nodes[index].kind->reads_entries) {
    const BoundNode& bound = tree.bound[tree.place_in_front(index, FrontCell::Bound)];
    if (tree.ports[bound.first_port + place].slot != PortBinding::kUnbound) return nullptr;
  }
  return &tree.cells[tree.nodes[index].params + place];
}

}  // namespace

std::optional<NodeQuestion> question_of(const Tree& tree, NodeIndex index) {
  if (tree.nodes[index].kind->answer == nullptr) return std::nullopt;
  NodeQuestion it;
  const auto constant = [&](std::int64_t place) -> const Value& {
    return tree.constants[static_cast<std::size_t>(place)];
  };
  it.options =
      std::get<std::vector<std::string>>(constant(constant_cell(tree, index, "options")->integer));
  const std::int64_t fallback = constant_cell(tree, index, "default")->integer;
  if (fallback != 0) it.fallback = std::get<std::string>(constant(fallback - 1));
  const Cell* const timeout = constant_cell(tree, index, "timeout");
  if (timeout != nullptr && timeout->number > 0) it.timeout = timeout->number;
  const Cell* const severity = constant_cell(tree, index, "severity");
  const auto& parameters = tree.labels[index].type->parameters;
  const auto words = std::ranges::find(parameters, "severity", &Parameter::name)->choices;
  if (severity != nullptr) it.severity = words[static_cast<std::size_t>(severity->integer)];
  return it;
}

void add_facts(const NodeType& type, ShapeNode& node) {
  node.latches |= type.latches;
  node.limits_time |= type.limits_time;
  node.holds_first |= type.holds_first_child;
  node.tries_again |= type.repeats_after == Status::Failure;
}

Shape shape_of(const Tree& tree) {
  Shape shape{.id = tree.id};
  shape.nodes.resize(tree.nodes.size());
  for (NodeIndex index = 0; index < tree.nodes.size(); ++index) {
    ShapeNode& node = shape.nodes[index];
    const NodeLabel& label = tree.labels[index];
    const bool has_parent = label.parent != index;
    // Not each path from the root down: those of a deep tree are long.
    node.path = (has_parent ? shape.nodes[label.parent].path : tree.id) + "/" + tree.segment(index);
    node.kind = label.type->id;
    node.name = label.name;
    if (has_parent) node.parent = label.parent;
    node.synchronization = synchronization(tree.nodes[index]);
    if (const auto list = barriers(tree, index)) node.barriers.emplace(list->begin(), list->end());
    node.delta = delta(tree, index);
    node.ignores_idle = ignores_idle(tree, index);
    node.paces = tree.nodes[index].kind->paced_child != nullptr;
    add_facts(*label.type, node);
    node.type = label.type;
    add_condition(tree, index, node);
    if (auto question = question_of(tree, index)) {
      node.question = std::make_shared<const NodeQuestion>(*std::move(question));
    }
    node.repeats = tree.nodes[index].kind->round != nullptr;
    if (!tree.is_group(index)) continue;
    node.resources = tree.group(index).resources;
    for_each_child(tree, index, [&](NodeIndex child) { node.members.push_back(child); });
  }
  const auto who = writers(tree);
  for (const Slot& slot : tree.slots) {
    shape.entries.push_back({.key = slot.name,
                             .type = std::string(type_name(slot.type, slot.object)),
                             .writers = who[shape.entries.size()],
                             .value_type = slot.type,
                             .typing = slot.typing});
  }
  Ports(tree, shape).add();
  add_members(tree, shape);
  complete(shape);
  for (const ShapeNode& node : shape.nodes) {
    if (!is_measured(node)) continue;
    for (const NodeIndex child : node.held()) {
      shape.nodes[child].is_guard = tree.nodes[child].is_guard != 0;
    }
  }
  return shape;
}

std::vector<const NodeType*> built_in_types(const LanguageRules& rules) {
  std::vector<const NodeType*> types;
  for (const NodeKind* kind : built_in_kinds(rules)) types.push_back(&kind->type);
  return types;
}

MostWithin most_within(std::size_t nodes) {
  return {.moments = Moments::kMost,
          .changes = Moments::most_changes(nodes),
          .progress = Moments::most_progress(nodes)};
}

}  // namespace lockstep::host

#include "engine/compile.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "base/core/pre_order.h"
#include "base/core/resource_set.h"
#include "engine/bound_node.h"
#include "engine/node_context.h"
#include "engine/node_scripts.h"
#include "engine/nodes/kinds.h"
#include "engine/resources.h"
#include "engine/writers.h"
#include "tree/pace.h"
#include "tree/paths.h"

namespace lockstep::host {
namespace {

const NodeKind* mock_of(NodeCategory category) {
  if (category == NodeCategory::Action) return &kMockAction;
  if (category == NodeCategory::Condition) return &kMockCondition;
  return category == NodeCategory::Control ? &kMockControl : &kMockDecorator;
}

const NodeKind* kind_of(const NodeType& type, const LanguageRules& rules) {
  if (type.mock != nullptr) return mock_of(type.category);
  if (type.leaf != nullptr) {
    if (type.arity.max != 0) return &kPluginControl;
    const bool is_at_once = type.category == NodeCategory::Condition && !rules.conditions_may_run;
    return is_at_once ? &kPluginCondition : &kPluginAction;
  }
  static const auto by_type = [] {
    std::unordered_map<const NodeType*, const NodeKind*> map;
    for (const LanguageRules* each : languages()) {
      for (const NodeKind* kind : each->kinds) map.emplace(&kind->type, kind);
    }
    return map;
  }();
  return by_type.at(&type);
}

// The same kind for parameters from entries. Most kinds read them before each tick.
const NodeKind* bound_kind_of(const NodeKind* kind) {
  static const auto by_kind = [] {
    std::unordered_map<const NodeKind*, NodeKind> map;
    for (const LanguageRules* each : languages()) {
      for (const NodeKind* plain : each->kinds) {
        for (const NodeKind* it : {plain, plain->paced, plain->obeying}) {
          if (it == nullptr) continue;
          NodeKind bound = *it;
          if (!it->chooses_to_read) bound.tick = tick_bound;
          bound.reads_entries = true;
          map.emplace(it, bound);
        }
      }
    }
    return map;
  }();
  return &by_kind.at(kind);
}

// The same kind below a node with hold="between".
const NodeKind* between_kind_of(const NodeKind* kind) {
  static const auto by_kind = [] {
    std::unordered_map<const NodeKind*, NodeKind> map;
    for (const LanguageRules* each : languages()) {
      for (const NodeKind* it : each->kinds) {
        if (it->tick_between == nullptr) continue;
        map.emplace(it, *it).first->second.tick = it->tick_between;
      }
    }
    return map;
  }();
  return &by_kind.at(kind);
}

// The same kind with a tick that runs the scripts of the node, too.
const NodeKind* hooked_kind_of(const NodeKind* kind) {
  static const auto by_kind = [] {
    std::unordered_map<const NodeKind*, NodeKind> map;
    const auto add = [&map](const NodeKind* it) {
      NodeKind& hooked = map.emplace(it, *it).first->second;
      hooked.tick = [](NodeContext& context, NodeIndex self) {
        return context.scripts().tick(self);
      };
    };
    for (const NodeKind* leaf :
         {&kPluginAction, kPluginAction.obeying, kPluginAction.committing, &kPluginCondition,
          &kPluginControl, &kMockAction, &kMockCondition, &kMockControl, &kMockDecorator}) {
      add(leaf);
    }
    for (const LanguageRules* each : languages()) {
      for (const NodeKind* plain : each->kinds) {
        for (const NodeKind* it : {plain, plain->paced, plain->obeying}) {
          if (it == nullptr) continue;
          add(it);
          add(bound_kind_of(it));
          if (it->tick_between != nullptr) add(between_kind_of(it));
        }
      }
    }
    return map;
  }();
  return &by_kind.at(kind);
}

class Compiler {
 public:
  explicit Compiler(const Definition& definition)
      : definition_(definition),
        constants_(definition.values.size(), kNone),
        cells_(definition.ports.size(), kNone) {}

  Tree compile() {
    tree_.id = definition_.id;
    tree_.stand_ins = definition_.stand_ins;
    tree_.rules = definition_.rules;
    tree_.boards = definition_.boards;
    tree_.shares_entries = definition_.shares_entries;
    tree_.words = definition_.words;
    tree_.nodes.reserve(definition_.nodes.size());
    tree_.ports.reserve(definition_.ports.size());
    tree_.constants.reserve(definition_.values.size());
    number_members();
    find_paced();
    for (const DefinitionNode& node : definition_.nodes) add(node);
    find_guards();
    let_look_between();
    add_scripts();
    tree_.readings = definition_.readings;
    add_hooks();
    add_groups();
    order_groups();
    find_gates();
    find_begun_once();
    list_children();
    count_followers();
    for (const BlackboardEntry& entry : definition_.entries) {
      tree_.slots.push_back(
          {entry.name, entry.type, entry.initial, entry.object, entry.typing, entry.is_present});
    }
    add_labels();
    find_fixed_parameters();
    return std::move(tree_);
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  const NodeKind* kind(const NodeType& type) {
    if (&type != last_type_) {
      last_type_ = &type;
      last_kind_ = kind_of(type, *definition_.rules);
    }
    return last_kind_;
  }

  // Which nodes pace, with the members of a barrier that does.
  void find_paced() {
    for (NodeIndex node = 0; node < definition_.nodes.size(); ++node) {
      if (paces(definition_, definition_.nodes[node])) pacing_.insert(node);
    }
    if (pacing_.empty()) return;
    for (const Member& member : tree_.members) {
      if (pacing_.contains(member.group)) pacing_.insert(member.node);
    }
  }

  // A node that paces, and a leaf or a time that obeys below one, has another kind.
  const NodeKind* kind_at(const DefinitionNode& from, NodeIndex self) {
    const NodeKind* plain = kind(*from.type);
    if (from.at_cut.commits && plain->committing != nullptr) return plain->committing;
    if (pacing_.empty()) return plain;
    if (plain->paced != nullptr && pacing_.contains(self)) return plain->paced;
    if (plain->obeying == nullptr || !from.is_slowed) return plain;
    return from.type->leaf == nullptr || from.type->can_be_slowed ? plain->obeying : plain;
  }

  void add(const DefinitionNode& from) {
    const auto self = static_cast<NodeIndex>(tree_.nodes.size());
    Node node{.kind = kind_at(from, self),
              .end = from.end,
              .children = children_of(from) & 0x7ffffffu,  // kMaxNodes is far less
              .synchronizes = static_cast<unsigned>(definition_.synchronization(from)) & 3u,
              .is_guard = from.type->category != NodeCategory::Action,
              .is_latched = false,
              .params = 0,
              .state = static_cast<std::uint32_t>(tree_.state_size)};
    tree_.keeps_over_skips |= node.kind->forget != nullptr;
    if (from.type->mock != nullptr) {
      if (!from.type->mock->outputs.empty()) node.params = add_ports(from);
    } else if (from.type->leaf != nullptr) {
      node.params = add_leaf(from, *node.kind);
    } else if (from.type->reads_ports) {
      node.params = add_ports(from);
    } else if (!numbers_.empty() && numbers_.contains(self)) {
      add_member(from, self, node);
    } else if (is_bound(from)) {
      add_bound(from, node);
    } else {
      node.params = add_parameters(from);
    }
    const std::size_t size =
        node.kind->state_size + std::size_t{node.kind->state_per_child} * node.children;
    tree_.state_size += (size + 7) / 8 * 8;
    tree_.nodes.push_back(node);
  }

  // Only of leaves that are called as the tree has them: not of those with scripts.
  void count_followers() {
    auto& leaves = tree_.leaves;
    for (std::size_t place = leaves.size(); place > 1; --place) {
      const LeafNode& next = leaves[place - 1];
      LeafNode& leaf = leaves[place - 2];
      const bool follows =
          next.node == leaf.node + 1 && tree_.nodes[next.node].kind == &kPluginAction;
      leaf.followers = follows ? next.followers + 1 : 0;
    }
  }

  void add_scripts() {
    for (const BoundScript& script : definition_.scripts) {
      tree_.scripts.push_back({script.code, script.entries, script.readings});
    }
  }

  void add_hooks() {
    if (definition_.hooks.empty()) return;
    tree_.hooks.assign(tree_.nodes.size(), HookedNode::kNoScript);
    for (NodeIndex node = 0; node < tree_.nodes.size(); ++node) {
      const std::uint32_t hooks = definition_.nodes[node].hooks;
      if (hooks == Port::kNone) continue;
      const NodeKind*& kind = tree_.nodes[node].kind;
      tree_.hooks[node] = static_cast<std::uint32_t>(tree_.hooked.size());
      tree_.hooked.push_back({node, kind, definition_.hooks[hooks]});
      HookedNode& hooked = tree_.hooked.back();
      const auto has = [&](Hook it) { return hooked.script(it) != HookedNode::kNoScript; };
      hooked.begins = has(Hook::FailureIf) || has(Hook::SuccessIf) || has(Hook::SkipIf);
      hooked.ends = has(Hook::OnSuccess) || has(Hook::OnFailure) || has(Hook::Post);
      hooked.of_plugin = definition_.nodes[node].type->leaf != nullptr;
      tree_.has_halt_hooks |= has(Hook::OnHalted);
      kind = hooked_kind_of(kind);
    }
  }

  // A group counts its members.
  std::uint32_t children_of(const DefinitionNode& from) const {
    if (from.type->category != NodeCategory::Group) return from.children;
    const std::size_t group = tree_.nodes.size() - definition_.nodes[0].end;
    return static_cast<std::uint32_t>(definition_.groups[group].members.size());
  }

  void number_members() {
    for (const DefinitionGroup& group : definition_.groups) {
      std::uint32_t number = 0;
      for (const std::uint32_t node : group.members) {
        numbers_.emplace(node, static_cast<std::uint32_t>(tree_.members.size()));
        tree_.members.push_back({.node = node, .group = group.node, .number = number++});
      }
    }
  }

  void add_groups() {
    std::uint32_t first = 0;
    for (const DefinitionGroup& group : definition_.groups) {
      const auto count = static_cast<std::uint32_t>(group.members.size());
      tree_.groups.push_back({.node = group.node,
                              .ancestor = definition_.common_ancestor(group.members),
                              .first = first,
                              .count = count,
                              .resources = group.resources,
                              .has_relatives = group.has_relatives});
      first += count;
    }
  }

  void order_groups() {
    tree_.group_order.resize(tree_.groups.size());
    std::iota(tree_.group_order.begin(), tree_.group_order.end(), 0u);
    std::ranges::stable_sort(tree_.group_order, {}, [this](std::uint32_t group) {
      return definition_.groups[group].rank;
    });
  }

  // Finds, for each member of a pool, the members of groups above it, and of a barrier just below.
  void find_gates() {
    for (Member& member : tree_.members) {
      if (!is_pool(tree_, member.group)) continue;
      member.first_gate = static_cast<std::uint32_t>(tree_.gates.size());
      for (NodeIndex node = member.node; node != 0;) {
        node = definition_.nodes[node].parent;
        if (numbers_.contains(node)) tree_.gates.push_back(node);
      }
      NodeIndex below = member.node + 1;
      while (tree_.nodes[below].children == 1 && !numbers_.contains(below)) ++below;
      if (waits_at_barrier(below)) tree_.gates.push_back(below);
      member.gates = static_cast<std::uint32_t>(tree_.gates.size()) - member.first_gate;
    }
  }

  bool waits_at_barrier(NodeIndex node) const {
    const auto it = numbers_.find(node);
    return it != numbers_.end() && !is_pool(tree_, tree_.members[it->second].group);
  }

  void add_member(const DefinitionNode& from, NodeIndex self, Node& node) {
    append_front(FrontCell::Member, numbers_.at(self));
    if (is_bound(from)) {
      add_bound(from, node);
      return;
    }
    append_front(FrontCell::Bound, 0);
    node.params = append_parameters(from);
    const auto& parameters = from.type->parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (!parameters[i].of_pool) continue;
      const DefinitionGroup& pool = definition_.groups[group_of(self)];
      const auto& names = std::get<std::string>(*definition_.constant(from, i));
      tree_.cells[node.params + i] = list_cell(resource_list(names, pool.resources).request());
    }
  }

  // The number of a member's group.
  std::size_t group_of(NodeIndex member) const {
    return tree_.members[numbers_.at(member)].group - definition_.nodes[0].end;
  }

  // A node is a guard when all of its children are.
  void find_guards() {
    for (auto node = static_cast<NodeIndex>(tree_.nodes.size()); node-- > 0;) {
      const DefinitionNode& from = definition_.nodes[node];
      Node& it = tree_.nodes[node];
      it.is_latched = it.is_guard == 0 && definition_.nodes[from.parent].type->latches;
      if (it.is_guard == 0) tree_.nodes[from.parent].is_guard = 0;
      if (!definition_.forgets(from)) continue;
      for (const NodeIndex child : children_in(tree_.nodes, node)) {
        tree_.nodes[child].is_latched = 0;
      }
    }
  }

  // What is inside of a guard is never held.
  void let_look_between() {
    std::vector<bool> is_inside(tree_.nodes.size());
    for (NodeIndex node = 0; node < definition_.nodes[0].end; ++node) {
      const DefinitionNode& from = definition_.nodes[node];
      const auto member = numbers_.find(node);
      const NodeIndex holder =
          member == numbers_.end() ? node : tree_.members[member->second].group;
      is_inside[node] =
          is_inside[from.parent] || definition_.holds_between(definition_.nodes[holder]);
      const NodeKind*& kind = tree_.nodes[node].kind;
      if (is_inside[node] && tree_.nodes[node].is_guard == 0 && kind->tick_between != nullptr)
        kind = between_kind_of(kind);
    }
  }

  // A barrier needs to know it of the nodes around its members.
  void find_begun_once() {
    if (tree_.groups.empty()) return;
    for (NodeIndex node = 1; node < definition_.nodes[0].end; ++node) {
      tree_.nodes[node].is_begun_once = !has_while(node) && parent_begins_once(node);
    }
  }

  bool has_while(NodeIndex node) const {
    if (tree_.hooks.empty() || tree_.hooks[node] == HookedNode::kNoScript) return false;
    return tree_.hooked[tree_.hooks[node]].script(Hook::While) != HookedNode::kNoScript;
  }

  bool parent_begins_once(NodeIndex node) const {
    const NodeIndex parent = definition_.nodes[node].parent;
    const NodeType& type = *definition_.nodes[parent].type;
    if (type.latches) return tree_.nodes[node].is_latched != 0;
    if (type.goes_on_after == Status::Idle) {
      // If its branch is skipped, so is an IfThenElse, and its condition may begin again.
      const bool is_condition = node == parent + 1 && definition_.nodes[parent].children > 1;
      return type.begins_child_once && !is_condition;
    }
    return has_memory(parent) || is_last_behind_conditions(parent, node);
  }

  bool has_memory(NodeIndex node) const {
    const DefinitionNode& it = definition_.nodes[node];
    const Value* memory = definition_.constant(it, "memory");
    return memory != nullptr && *memory == Value(true);
  }

  // An earlier child that takes time would halt the last one when its turn comes again.
  bool is_last_behind_conditions(NodeIndex parent, NodeIndex node) const {
    const auto is_plain_condition = [this](NodeIndex child) {
      const DefinitionNode& it = definition_.nodes[child];
      return it.type->category == NodeCategory::Condition && it.children == 0 &&
             it.hooks == Port::kNone;
    };
    for (NodeIndex child = parent + 1; child != node; child = tree_.nodes[child].end) {
      if (!is_plain_condition(child)) return false;
    }
    return tree_.nodes[node].end == tree_.nodes[parent].end;
  }

  // Control nodes of plugins name their children by index.
  void list_children() {
    for (LeafNode& leaf : tree_.leaves) {
      leaf.first_child = static_cast<std::uint32_t>(tree_.children.size());
      leaf.children = tree_.nodes[leaf.node].children;
      if (leaf.children == 0) continue;
      for (const NodeIndex child : children_in(tree_.nodes, leaf.node)) {
        tree_.children.push_back(child);
      }
    }
  }

  std::uint32_t add_leaf(const DefinitionNode& from, const NodeKind& kind) {
    const auto index = static_cast<std::uint32_t>(tree_.leaves.size());
    if (from.type->can_be_restored) tree_.kept_leaves.push_back(index);
    tree_.leaves.push_back({.node = static_cast<NodeIndex>(tree_.nodes.size()),
                            .type = from.type,
                            .first_port = add_ports(from),
                            .is_slowed = from.is_slowed,
                            .keeps_pace = kind.state_size > 0,
                            .at_cut = from.at_cut});
    return index;
  }

  std::uint32_t add_ports(const DefinitionNode& from) {
    const auto first = static_cast<std::uint32_t>(tree_.ports.size());
    tree_.ports.resize(first + from.type->parameters.size());
    const Port* port = definition_.ports.data() + from.first;
    for (PortBinding& binding : std::span(tree_.ports).subspan(first)) {
      binding.slot = port->entry;
      if (port->value != Port::kNone) binding.constant = add_constant(port->value);
      ++port;
    }
    return first;
  }

  bool is_bound(const DefinitionNode& from) const {
    const auto ports = std::span(definition_.ports).subspan(from.first);
    for (std::size_t i = 0; i < from.type->parameters.size(); ++i) {
      if (ports[i].entry != Port::kNone) return true;
    }
    return false;
  }

  void add_bound(const DefinitionNode& from, Node& node) {
    append_front(FrontCell::Bound, tree_.bound.size());
    tree_.bound.push_back({.node = static_cast<NodeIndex>(tree_.nodes.size()),
                           .kind = node.kind,
                           .first_port = add_ports(from)});
    node.kind = bound_kind_of(node.kind);
    node.params = append_parameters(from);
  }

  // For example, seconds="{s}" in a tree that each SubTree gives another `s`.
  void find_fixed_parameters() {
    if (tree_.bound.empty()) return;
    const auto takes_names = [](const NodeLabel& label) {
      return std::ranges::any_of(label.type->parameters,
                                 [](const Parameter& it) { return it.is_key || it.names_entry; });
    };
    if (std::ranges::any_of(tree_.labels, takes_names)) return;
    const auto writers_of = writers(tree_);
    for (BoundNode& bound : tree_.bound) {
      const auto ports =
          std::span(tree_.ports).subspan(bound.first_port, bound.kind->type.parameters.size());
      bound.may_change = std::ranges::any_of(ports, [&](const PortBinding& port) {
        return port.slot != PortBinding::kUnbound && !writers_of[port.slot].empty();
      });
    }
  }

  // Subtrees that are used often share their constants.
  std::uint32_t add_constant(std::uint32_t value) {
    std::uint32_t& constant = constants_[value];
    if (constant == kNone) {
      constant = static_cast<std::uint32_t>(tree_.constants.size());
      tree_.constants.push_back(definition_.values[value]);
    }
    return constant;
  }

  std::uint32_t add_parameters(const DefinitionNode& from) {
    if (from.type->parameters.empty()) return 0;
    std::uint32_t& first = cells_[from.first];
    if (first != kNone) return first;
    first = append_parameters(from);
    return first;
  }

  // Call it for a member first, then for what is bound, then append the parameters.
  void append_front(FrontCell /*which*/, std::size_t place) {
    static_assert(static_cast<int>(FrontCell::Bound) == 1 &&
                  static_cast<int>(FrontCell::Member) == 2);
    tree_.cells.push_back({.integer = static_cast<std::int64_t>(place)});
  }

  std::uint32_t append_parameters(const DefinitionNode& from) {
    const auto first = static_cast<std::uint32_t>(tree_.cells.size());
    for (std::size_t i = 0; i < from.type->parameters.size(); ++i) {
      const Value* value = definition_.constant(from, i);
      const std::uint32_t script = definition_.ports[from.first + i].script;
      if (from.type->parameters[i].is_script) {
        tree_.cells.push_back({.integer = script});
      } else {
        tree_.cells.push_back(value != nullptr ? cell(from.type->parameters[i], *value)
                                               : Cell{.integer = 0});
      }
    }
    return first;
  }

  // A constant that is none of some words, and no name of something else.
  static bool is_plain_text(const Parameter& it) {
    return it.constant && it.type == ValueType::String && it.choices.empty() && it.group.empty();
  }

  Cell cell(const Parameter& parameter, const Value& value) {
    if (std::holds_alternative<std::vector<std::string>>(value)) {
      tree_.constants.push_back(value);
      return {.integer = static_cast<std::int64_t>(tree_.constants.size() - 1)};
    }
    if (is_plain_text(parameter) && std::holds_alternative<std::string>(value)) {
      tree_.constants.push_back(value);
      return {.integer = static_cast<std::int64_t>(tree_.constants.size())};
    }
    const auto* list = std::get_if<std::vector<double>>(&value);
    return list == nullptr ? scalar_cell(parameter, value) : list_cell(*list);
  }

  Cell list_cell(std::span<const double> list) {
    const auto first = static_cast<std::uint32_t>(tree_.numbers.size());
    tree_.numbers.insert(tree_.numbers.end(), list.begin(), list.end());
    return {.list = {first, static_cast<std::uint32_t>(list.size())}};
  }

  void add_labels() {
    auto names = std::make_shared<std::string>();
    const auto is_own = [](const DefinitionNode& node) {
      return node.name.data() != node.type->id.data();
    };
    std::size_t bytes = 0;
    for (const DefinitionNode& node : definition_.nodes)
      bytes += is_own(node) ? node.name.size() : 0;
    names->reserve(bytes);  // exactly, so that the views stay
    tree_.labels.reserve(definition_.nodes.size());
    const std::vector<std::uint32_t> numbers = sibling_numbers(definition_);
    for (const DefinitionNode& node : definition_.nodes) {
      std::string_view name = node.type->id;
      if (is_own(node)) {
        names->append(node.name);
        name = std::string_view(*names).substr(names->size() - node.name.size());
      }
      tree_.labels.push_back({.name = name,
                              .type = node.type,
                              .parent = node.parent,
                              .repeat = numbers[tree_.labels.size()]});
    }
    tree_.names = std::move(names);
  }

  const Definition& definition_;
  Tree tree_;
  std::vector<std::uint32_t> constants_;  // of each value of the definition: its constant
  std::vector<std::uint32_t> cells_;      // of each first port of a node: its first cell
  // The place of each member of a group in Tree::members.
  std::unordered_map<NodeIndex, std::uint32_t> numbers_;
  std::unordered_set<NodeIndex> pacing_;
  const NodeType* last_type_ = nullptr;
  const NodeKind* last_kind_ = nullptr;
};

}  // namespace

Tree compile(const Definition& definition) {
  return Compiler(definition).compile();
}

}  // namespace lockstep::host

// The compiled tree: flat, in pre-order, immutable, shareable between threads. A subtree is the
// range [i, nodes[i].end); its first child is i + 1 and the sibling after child c is nodes[c].end.
// Everything that changes during a run is in RunState and in the leaves.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/blackboard/board.h"
#include "base/blackboard/entry.h"
#include "base/core/after_cut.h"
#include "base/core/hook.h"
#include "base/core/language.h"
#include "engine/node.h"
#include "language/expression/reading.h"
#include "language/expression/script_enums.h"

namespace lockstep::host {

class Expression;

// The compiler's own cells in front of the parameters of some nodes, counted back from the first
// parameter. Each is a place in another list of the tree.
enum class FrontCell : std::uint8_t {
  Bound = 1,  // of a bound node: in Tree::bound
  Member,     // of a member of a group, which has both: in Tree::members
};

// Where a parameter gets its value.
struct PortBinding {
  static constexpr std::uint32_t kUnbound = 0xffffffff;
  std::uint32_t slot = kUnbound;      // blackboard entry
  std::uint32_t constant = kUnbound;  // in Tree::constants; with a slot: until that is written
};

// A node of a plugin: a leaf, control node or decorator.
struct LeafNode {
  NodeIndex node;
  const NodeType* type;
  std::uint32_t first_port;       // in Tree::ports
  std::uint32_t first_child = 0;  // in Tree::children
  std::uint32_t children = 0;     // how many
  std::uint32_t followers = 0;    // actions of plugins next to it in pre-order, up to another node
  bool is_slowed = false;         // a node above it has pace="true", and it obeys
  bool keeps_pace = false;  // its kind keeps a LeafPace: it obeys, and pace counts; or commits
  LeafAtCut at_cut = {};
};

// A built-in node with a parameter from an entry. Its kind in Tree::nodes reads the entries and
// then ticks like this kind.
struct BoundNode {
  NodeIndex node;
  const NodeKind* kind;
  std::uint32_t first_port;  // in Tree::ports, one for each parameter
  bool may_change = true;    // something in the tree may write one of its entries
};

// A compiled script and the entry of each name in it. Without code: the entry that has its text.
struct Script {
  std::shared_ptr<const Expression> code;
  std::vector<std::uint32_t> slots;
  std::vector<std::uint32_t> readings = {};  // of each of Expression::readings(), in Tree::readings
};

// A node with scripts around its ticks. Its kind in Tree::nodes runs them and ticks like this kind.
struct HookedNode {
  NodeIndex node;
  const NodeKind* kind;
  std::array<std::uint32_t, kHooks> scripts;  // in Tree::scripts; or kNoScript
  bool begins = false;                        // one of them may decide before the first tick
  bool ends = false;                          // one of them runs after the last tick
  bool of_plugin = false;                     // it has a slot in the run

  static constexpr std::uint32_t kNoScript = 0xffffffff;
  std::uint32_t script(Hook hook) const { return scripts[static_cast<std::size_t>(hook)]; }
};

struct Slot {
  std::string name;  // the key, after the path of its SubTree
  ValueType type;
  Value initial;
  const ObjectType* object = nullptr;  // of type Object: which
  Typing typing = Typing::Strict;
  bool is_present = true;  // from the beginning
};

struct NodeLabel {
  std::string_view name;  // the name attribute, in Tree::names; else the type's id
  const NodeType* type;
  NodeIndex parent;          // the root is its own, and so is a group
  std::uint32_t repeat = 0;  // makes the name unique among its siblings: Tree::segment
};

// Nodes anywhere in the tree that a declaration beside it joins. The declaration is a node without
// children behind the root's subtree; it is ticked before the root.
struct Group {
  NodeIndex node;                           // of the declaration
  NodeIndex ancestor;                       // the lowest that all members are below
  std::uint32_t first, count;               // in Tree::members
  std::vector<std::string> resources = {};  // of a pool: their names, in the order of their bits
  bool has_relatives = false;  // a member is inside of another one, or takes over from one
};

struct Member {
  NodeIndex node;
  NodeIndex group;       // the node of the declaration
  std::uint32_t number;  // among the members of the group
  // In Tree::gates: the members of other groups that withhold its ticks when they hold.
  std::uint32_t first_gate = 0, gates = 0;
};

struct Tree {
  std::vector<Node> nodes;  // the root and its subtree, then one for each group
  std::vector<Cell> cells;
  std::vector<double> numbers;
  std::vector<LeafNode> leaves;
  std::vector<std::uint32_t> kept_leaves;  // in `leaves`: those that may go on after a cut
  std::vector<NodeIndex> children;         // of the control nodes of plugins
  std::vector<BoundNode> bound;
  std::vector<Script> scripts;
  std::vector<BoundReading> readings;  // before each tick
  std::vector<HookedNode> hooked;
  std::vector<std::uint32_t> hooks;  // of each node, in `hooked`; empty when no node has scripts
  bool has_halt_hooks = false;
  bool keeps_over_skips = false;  // some kind has NodeKind::forget
  std::vector<Group> groups;      // in the order of their nodes
  std::vector<Member> members;    // of each group, in pre-order
  std::vector<NodeIndex> gates;
  std::vector<std::uint32_t> group_order;  // in which they are ticked
  std::vector<PortBinding> ports;  // of leaves and bound nodes, each type's parameters in order
  std::vector<Value> constants;
  std::vector<Slot> slots;
  std::shared_ptr<const ScriptEnums> words = {};  // for scripts that are compiled at run time
  bool shares_entries = false;  // other threads than that of its run use them, too
  std::vector<Board> boards;    // if names are looked up at run time; in the order of their nodes
  std::size_t state_size = 0;   // bytes of all node states
  const LanguageRules* rules = &kLockstepRules;
  std::string id;                 // of the main BehaviorTree
  std::vector<NodeLabel> labels;  // not touched while ticking
  // The text that the labels' names point into. A copy of the tree shares it.
  std::shared_ptr<const std::string> names;
  std::shared_ptr<const void> stand_ins = {};  // the types of some nodes

  bool is_group(NodeIndex node) const { return node >= nodes[0].end; }
  const Group& group(NodeIndex node) const { return groups[node - nodes[0].end]; }
  std::span<const Member> members_of(NodeIndex group_node) const {
    const Group& it = group(group_node);
    return std::span(members).subspan(it.first, it.count);
  }
  // Only a node whose kind has a parameter that names a group has one.
  const Member& membership(NodeIndex node) const {
    return members[place_in_front(node, FrontCell::Member)];
  }
  std::uint32_t place_in_front(NodeIndex node, FrontCell which) const {
    const Cell& cell = cells[nodes[node].params - static_cast<std::uint32_t>(which)];
    return static_cast<std::uint32_t>(cell.integer);
  }
  std::span<const NodeIndex> gates_of(const Member& member) const {
    return std::span(gates).subspan(member.first_gate, member.gates);
  }

  // The board of the innermost SubTree that a node is in; 0: the main tree.
  std::uint32_t board_of(NodeIndex node) const;

  // A node's part of the path: its name, or "name#2" for the second sibling of that name.
  std::string segment(NodeIndex node) const;
  // "OpenDoor/pull/arm": the tree's id and the segments down to the node.
  std::string path(NodeIndex node) const;
  // The same, in the memory of `text`.
  void path(NodeIndex node, std::string& text) const;
};

// The cell of a value that is no list; of an absent one: 0.
Cell scalar_cell(const Parameter& parameter, const Value& value);

}  // namespace lockstep::host

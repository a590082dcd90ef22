// NodeType declares a node kind: id, arity, parameters, and the rules between them. Built-in nodes
// and leaves of plugins use the same description. The checker, `lockstep nodes`, the XSD and
// docs/nodes.md are all made from these rows.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/status.h"
#include "base/core/value.h"

struct lockstep_plugin;
struct lockstep_leaf_type;

namespace lockstep::host {

// A Group is declared beside the trees and joins nodes anywhere in them, its members.
enum class NodeCategory : std::uint8_t { Control, Decorator, Action, Condition, SubTree, Group };

enum class Direction : std::uint8_t { Input, Output, InOut };

// How a control node synchronizes its children, or a group its members. Resources: a pool holds
// those that need what others own.
enum class Synchronization : std::uint8_t { None, Absolute, Relative, Resources };
// A pool does not.
constexpr bool compares_progress(Synchronization synchronization) {
  return synchronization == Synchronization::Absolute ||
         synchronization == Synchronization::Relative;
}

// The effect of a tick of a node that has completed once in the run.
enum class Again : std::uint8_t { Acts, ReturnsResult, IsSkipped };

// How the progress of a node consists of that of its children, where their places decide it.
enum class ProgressShare : std::uint8_t {
  NotByPlace,
  EachChild,    // the children come one after the other, each with the same share
  EachButLast,  // likewise, but the last child is apart: while it runs, its progress is the node's
  EachRound,    // the child begins as often as the first parameter says, each with the same share
};

// Numbers that a parameter may take. The ends belong to it unless said otherwise.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_excluded = false;
};

// An attribute of a node: a constant, or the value of a blackboard entry that it names as {key}.
// The parameters of leaves are also called ports.
struct Parameter {
  std::string_view name;
  ValueType type;
  std::string_view doc;
  std::optional<std::string_view> default_text = {};  // as it would be written in the tree
  std::string_view default_key = {};  // the entry that it is bound to where it is left out
  bool required = false;
  Direction direction = Direction::Input;
  std::string_view unit = {};                      // "s", "" for none
  Range range = {};                                // numbers, and each number of a list
  std::span<const std::string_view> choices = {};  // strings: the words that are allowed
  const ObjectType* object = nullptr;              // of type Object: which
  bool constant = false;                           // shapes the tree, so it is never a {key}
  std::string_view group = {};  // its value names a group of this type: the node is a member
  bool of_pool = false;         // its value names resources of that group: base/core/resource_set.h
  bool is_script = false;       // a text that is compiled: expression/
  bool is_template = false;     // such a text is itself a text, with the values of entries: {key}
  bool names_entry = false;     // "k" is the entry k, as "{k}" is
  bool is_generic = false;      // takes a value of any type; `type` is String
  bool is_hint = false;         // a model says so, which may be older than the leaf
  bool is_key = false;          // "k" is the entry k; "{k}" is the entry that has its name
  bool own_only = false;        // of an is_key: only an entry of this tree, not of an outer one

  // Whether it is for an entry that the node may write. Of an is_key, one with own_only removes it.
  bool writes() const { return direction != Direction::Input || is_key; }
};

struct Arity {
  std::uint32_t min = 0;
  std::uint32_t max = std::numeric_limits<std::uint32_t>::max();
};

// A mistake in the parameters of a node.
struct RuleBreak {
  int parameter = -1;  // its index, or -1: the node itself
  std::string message;
  std::string hint;
};

// The parameters of one node, in the order of NodeType::parameters.
struct ParameterValues {
  std::span<Value> values;  // monostate: absent, or from an entry
  std::uint32_t children;   // how many the node has
  // Bit i: parameter i comes from an entry, and its value is not known yet.
  std::uint64_t from_entry = 0;

  bool is_given(unsigned index) const {
    return (from_entry >> index & 1) != 0 || !std::holds_alternative<NoValue>(values[index]);
  }
};

// A stand-in for a node that no plugin has returns this result: an action after a time, a condition
// at once.
struct Mock {
  Status result = Status::Success;
  double seconds = 1;
  std::vector<Value> outputs = {};  // of each port what it then writes; NoValue: nothing
};

class ElementTypes;

// Which of its parameters say how a synchronized node holds what is in it.
struct HoldingParameters {
  static constexpr unsigned kNone = 0xffffffff;
  unsigned barriers = kNone, at_barrier = kNone;  // of one that may be Absolute
  unsigned delta = kNone;                         // of one that may be Relative
  unsigned idle = kNone;                          // of a barrier beside the trees
  unsigned hold = kNone;                          // whether a Sequence in it looks at the limit
};

struct NodeType {
  std::string_view id;  // the XML tag
  NodeCategory category;
  std::string_view doc;
  Arity arity = {};
  std::span<const Parameter> parameters = {};
  // Checks rules between parameters, and fills in values that follow from others. May be null.
  // Called when the tree is loaded, and during a run after an entry was written.
  std::optional<RuleBreak> (*rule)(const ParameterValues& parameters) = nullptr;
  // The rest is for advice and drawings.
  std::string_view sign = {};  // as papers draw it, "→"; "": by its id
  Again again = Again::Acts;
  ProgressShare progress_share = ProgressShare::NotByPlace;
  Synchronization synchronization = Synchronization::None;
  HoldingParameters holding = {};
  Status goes_on_after = Status::Idle;  // children are ticked from the left, each after this result
  bool is_reactive = false;             // it begins with its first child in every tick
  bool latches = false;                 // a parallel: a child with actions is not ticked again
  bool begins_child_once = false;       // no child begins again, but for the first of several
  bool keeps_first_child = false;       // the first child is ticked again without a reset
  bool has_branches = false;            // the result of the first child chooses another one
  Status repeats_after = Status::Idle;  // a decorator that begins its child again after this result
  bool inverts = false;                 // a decorator that swaps Success and Failure
  bool can_run = false;                 // Running is its own result, not only a child's
  bool limits_time = false;             // a decorator that fails, and halts its child, after a time
  bool real_time = false;               // an action that continues to work between ticks
  bool has_progress = true;             // false: an action that reports none, so 0 until Success
  bool can_be_slowed = false;           // an action that obeys a pace: docs/pacing.md
  bool can_be_restored = false;         // an action that may go on after a cut: docs/resume.md
  bool holds_first_child = false;       // a synchronized node that never holds the others
  bool is_of_robots = false;            // a group whose members run trees of their own
  bool answers_late = false;            // an action whose answers may count a tick later: a program
  bool asks = false;                    // an action that waits for the answer of a person
  bool opens_entries = false;           // a leaf that uses entries that no port names
  bool reads_ports = false;             // a built-in kind that reads its values as leaves do
  std::string_view plugin = {};         // the plugin it comes from; "" = built in
  const Mock* mock = nullptr;           // not null: a stand-in
  bool is_guess = false;                // a stand-in that is perhaps a condition
  // An element may have more parameters, whose names these patterns match: "goal.*;result.*".
  std::string_view more_parameters = {};
  const ElementTypes* element_types = nullptr;  // which, and their types; null: it is known here
  // A leaf of a plugin has both; they are null for built-ins.
  const lockstep_plugin* origin = nullptr;
  const lockstep_leaf_type* leaf = nullptr;
};

constexpr std::string_view to_string(NodeCategory category) {
  constexpr std::string_view kNames[] = {"control node", "decorator", "action",
                                         "condition",    "subtree",   "group"};
  return kNames[static_cast<unsigned>(category)];
}

constexpr std::string_view to_string(Direction direction) {
  constexpr std::string_view kNames[] = {"in", "out", "inout"};
  return kNames[static_cast<unsigned>(direction)];
}

}  // namespace lockstep::host

// The checked meaning of a project: one tree in pre-order, subtrees expanded, parameters typed,
// keys resolved to blackboard entries. The engine compiles it. It has everything that is needed
// after the documents are gone. Views point into the project.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/blackboard/board.h"
#include "base/blackboard/entry.h"
#include "base/core/after_cut.h"
#include "base/core/hook.h"
#include "base/core/language.h"
#include "base/core/node_type.h"
#include "base/core/place.h"
#include "language/expression/expression.h"

namespace lockstep::host {

class StandIns;

struct DefinitionNode {
  const NodeType* type;
  std::uint32_t end;       // one past the last descendant
  std::uint32_t parent;    // the root is its own
  std::uint32_t children;  // how many
  std::uint32_t first;     // in `ports`, one for each of type->parameters
  std::string_view name;   // the name attribute, else the id
  Place place = {};
  std::uint32_t written = 0xffffffff;  // its first in Definition::written; or none
  std::uint32_t hooks = 0xffffffff;    // in Definition::hooks; or none
  bool is_slowed = false;  // below a node that paces, with a leaf that obeys: tree/pace.h
  LeafAtCut at_cut = {};
};

// An attribute as written, with arguments substituted. Attributes that only name the node are left
// out.
struct WrittenAttribute {
  std::string_view name;
  std::string_view value;
  bool is_last;  // of its node
  Place place = {};
};

// Where a parameter gets its value. Neither: it is absent, or an output that goes nowhere.
struct Port {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t entry = kNone;  // in `entries`
  std::uint32_t value = kNone;  // in `values`; with an entry: its value until somebody writes it
  // A parameter that is a script has it in Definition::scripts, beside the text in `values`.
  std::uint32_t script = kNone;
};

struct BlackboardEntry {
  std::string name;  // the key, after the path of names to its SubTree
  ValueType type = ValueType::String;
  Value initial;                       // monostate: none
  Place first_use = {};                // of the attribute that names it first
  const ObjectType* object = nullptr;  // of type Object: which
  Typing typing = Typing::Strict;
  bool is_present = true;     // from the beginning; false: until something makes it
  bool is_set_later = false;  // from outside, while the tree runs
};

// A script, with the entry of each name that it uses.
struct BoundScript {
  std::shared_ptr<const Expression> code = nullptr;  // null: it is in an entry
  std::uint32_t inside = 0;                          // the SubTree that it is in; 0: the main tree
  std::vector<std::uint32_t> entries =
      {};            // of each of Expression::names(); or the one that has it
  Place place = {};  // of its attribute
  // Of each of Expression::readings(); `renamed`: the name in the project of the barrier or pool
  // that it names, where a SubTree or a file gives that another one here, else "".
  std::vector<std::uint32_t> readings = {};
  std::vector<std::string_view> renamed = {};
};

// The scripts of a node, in Definition::scripts; Port::kNone where it has none.
using NodeHooks = std::array<std::uint32_t, kHooks>;

// A declaration beside the trees that nodes of the tree name.
struct DefinitionGroup {
  std::uint32_t node;                       // in `nodes`: behind the root's subtree, its own parent
  std::vector<std::uint32_t> members = {};  // in pre-order
  std::vector<std::string> resources = {};  // of a pool: their names
  std::uint32_t rank = 0;                   // before each tick, lower ranks are ticked first
  // Of a pool: a member is inside of another one, or comes after one in a Sequence.
  bool has_relatives = false;
};

// A property that the main file declares. Its text names nodes of the expanded tree.
struct WrittenProperty {
  std::string_view name, text;
  Place place;  // of the text
};

struct Definition {
  std::string_view id;
  const LanguageRules* rules = &kLockstepRules;
  std::shared_ptr<const ScriptEnums> words = {};  // for scripts that are compiled at run time
  std::vector<DefinitionNode> nodes;  // the root and its subtree, then one for each group
  std::vector<Value> values;
  std::vector<Port> ports;
  std::vector<BlackboardEntry> entries;
  std::vector<WrittenAttribute> written = {};
  std::vector<WrittenProperty> properties = {};
  std::vector<DefinitionGroup> groups = {};  // in the order of their nodes
  std::vector<NodeHooks> hooks = {};
  std::vector<BoundScript> scripts = {};
  std::vector<BoundReading> readings = {};
  std::vector<Board> boards =
      {};                       // if names are looked up at run time; in the order of their nodes
  bool shares_entries = false;  // leaves, or a program, use them by their names at any time
  std::list<std::string> texts = {};               // names that are not as a document has them
  std::shared_ptr<const StandIns> stand_ins = {};  // the types of some nodes

  // A parameter that is a constant; null when it is absent, comes from an entry, or the type has
  // none of that name.
  const Value* constant(const DefinitionNode& node, std::size_t parameter) const {
    if (parameter >= node.type->parameters.size()) return nullptr;
    const Port& port = ports[node.first + parameter];
    return port.entry == Port::kNone && port.value != Port::kNone ? &values[port.value] : nullptr;
  }

  const Value* constant(const DefinitionNode& node, std::string_view parameter) const {
    const auto place = std::ranges::find(node.type->parameters, parameter, &Parameter::name);
    return constant(node, static_cast<std::size_t>(place - node.type->parameters.begin()));
  }

  // The list that a pool declares, or that a member names: a constant, or the start value of an
  // entry; "" if neither.
  std::string_view resources_of(const DefinitionNode& node) const {
    const auto place = std::ranges::find(node.type->parameters, "resources", &Parameter::name);
    const Port& port =
        ports[node.first + static_cast<std::size_t>(place - node.type->parameters.begin())];
    if (port.entry == Port::kNone && port.value == Port::kNone) return {};
    const Value& value =
        port.entry != Port::kNone ? entries[port.entry].initial : values[port.value];
    const auto* list = std::get_if<std::string>(&value);
    return list == nullptr ? std::string_view() : *list;
  }

  // Whether a parameter is there, as a value or from an entry.
  bool has(const DefinitionNode& node, std::size_t parameter) const {
    if (parameter >= node.type->parameters.size()) return false;
    const Port& port = ports[node.first + parameter];
    return port.entry != Port::kNone || port.value != Port::kNone;
  }
  bool has(const DefinitionNode& node, std::string_view parameter) const {
    const auto place = std::ranges::find(node.type->parameters, parameter, &Parameter::name);
    return has(node, static_cast<std::size_t>(place - node.type->parameters.begin()));
  }

  // How often such a node begins its child (ProgressShare::EachRound); at most 0: for ever;
  // nothing: an entry says it.
  std::optional<std::int64_t> rounds(const DefinitionNode& node) const {
    if (!has(node, node.type->parameters[0].name)) return 0;
    const Value* times = constant(node, std::size_t{0});
    return times == nullptr ? std::nullopt : std::optional(std::get<std::int64_t>(*times));
  }

  // A group whose members use its resources.
  bool is_pool(const DefinitionGroup& group) const {
    return nodes[group.node].type->synchronization == Synchronization::Resources;
  }

  // A barrier with a delta holds as ParallelRelative does.
  Synchronization synchronization(const DefinitionNode& node) const {
    return has(node, node.type->holding.delta) ? Synchronization::Relative
                                               : node.type->synchronization;
  }

  // A barrier whose members wait for those that are idle.
  bool waits(const DefinitionGroup& group) const {
    const DefinitionNode& node = nodes[group.node];
    const unsigned idle = node.type->holding.idle;
    return idle < node.type->parameters.size() && *constant(node, idle) == Value("wait");
  }

  // Says for each script whether its value is a yes or a no.
  std::vector<bool> conditions() const {
    std::vector<bool> are(scripts.size());
    const auto add = [&](std::uint32_t script) {
      if (script != Port::kNone) are[script] = true;
    };
    for (const NodeHooks& it : hooks) {
      for (const Hook hook : {Hook::FailureIf, Hook::SuccessIf, Hook::SkipIf, Hook::While}) {
        add(it[static_cast<std::size_t>(hook)]);
      }
    }
    for (const DefinitionNode& node : nodes) {
      const NodeCategory category = node.type->category;  // a decorator's decides, too
      const bool waits = category == NodeCategory::Action && node.type->can_run;
      if (category != NodeCategory::Condition && category != NodeCategory::Decorator && !waits)
        continue;
      for (std::size_t i = 0; i < node.type->parameters.size(); ++i) {
        if (!node.type->parameters[i].is_template) add(ports[node.first + i].script);
      }
    }
    return are;
  }

  // The lowest node that has all of these below it. They are in pre-order, and none is below
  // another.
  std::uint32_t common_ancestor(std::span<const std::uint32_t> below) const {
    std::uint32_t ancestor = nodes[below.front()].parent;
    while (nodes[ancestor].end <= below.back()) ancestor = nodes[ancestor].parent;
    return ancestor;
  }

  // A member of a pool that owns resources until its child completes.
  bool keeps(const DefinitionNode& member) const {
    const Value* keep = constant(member, "keep");
    const Value* on_change = constant(member, "on_change");
    return (keep != nullptr && *keep == Value(true)) ||
           (on_change != nullptr && *on_change != Value("release"));
  }

  // A synchronized node, or a barrier, that also looks between the children of a Sequence.
  bool holds_between(const DefinitionNode& node) const {
    const unsigned hold = node.type->holding.hold;
    if (hold == HoldingParameters::kNone) return false;
    const Value* const value = constant(node, hold);
    return value != nullptr && *value == Value("between");
  }

  // A control node with memory="false". To one of a plugin, and so to a stand-in, a port of that
  // name means something else.
  bool forgets(const DefinitionNode& node) const {
    const NodeType& type = *node.type;
    const bool is_built_in = type.plugin.empty() && type.mock == nullptr;
    if (!is_built_in || type.category != NodeCategory::Control) return false;
    for (std::size_t i = 0; i < type.parameters.size(); ++i) {
      if (type.parameters[i].name == "memory") return *constant(node, i) == Value(false);
    }
    return false;
  }

  std::span<const WrittenAttribute> attributes(const DefinitionNode& node) const {
    if (node.written >= written.size()) return {};
    auto last = written.begin() + node.written;
    while (!last->is_last) ++last;
    return {written.begin() + node.written, last + 1};
  }
};

// The limits of a tree. The message that refuses a tree names the limit.
inline constexpr std::uint32_t kMaxNodes = 4'000'000;
inline constexpr std::uint32_t kMaxDepth = 1'000;
// All paths together: recordings, messages and leaves contain them.
inline constexpr std::uint64_t kMaxPathBytes = std::uint64_t{512} << 20u;

}  // namespace lockstep::host

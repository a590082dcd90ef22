// The row of a built-in node kind: its declaration and its functions. Each file in nodes/ defines
// one or a few rows; nodes/kinds.h lists them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/core/language.h"
#include "base/core/node_type.h"
#include "trace/node_state.h"

namespace lockstep::host {

class NodeContext;
class RunView;
struct PacedChild;

// The behavior of a node that has completed and is ticked again though its parent did not reset it.
enum class Unreset : std::uint8_t {
  Begins,       // from its beginning
  GoesOn,       // as if it ran
  KeepsResult,  // it is not ticked
};

// What the bytes that a node keeps mean at the place of an equal node.
enum class IfMoved : std::uint8_t {
  Differs,
  Same,
  FromChild,  // the same, but that they begin with the number of a child, or with 0
};

struct NodeKind {
  NodeType type;
  // One tick. Returns Running, Success, Failure or Skipped. Does not allocate; does not throw
  // itself. Of a group: before the root is ticked, in every tick; it is Idle when it begins again.
  Status (*tick)(NodeContext& context, NodeIndex self);
  // Called only while the node is Running; idle and failed nodes have 0, successful ones 1. In
  // [0,1].
  double (*progress)(NodeContext& context, NodeIndex self);
  std::uint32_t state_size = 0;       // bytes in RunState
  std::uint32_t state_per_child = 0;  // and this many more for each child
  // May be null. Called for a running node in a subtree that is halted or held. A node that was
  // held is Activity::Paused in its next tick.
  void (*halt)(NodeContext& context, NodeIndex self) = nullptr;
  void (*pause)(NodeContext& context, NodeIndex self) = nullptr;
  // May be null. What the node keeps while it is skipped is over: its parent begins again, or was
  // halted.
  void (*forget)(NodeContext& context, NodeIndex self) = nullptr;
  // Between two ticks: brings what the node keeps to the one form that stands for all from which it
  // goes on in the same way. Called also where it does not run. Each kind that keeps something has
  // one: see engine/nodes/fold.h.
  void (*fold)(NodeContext& context, NodeIndex self) = nullptr;
  // May be null. A script has decided the result of an activation before its first tick.
  void (*decided)(NodeContext& context, NodeIndex self, Status result) = nullptr;
  // May be null: then an action that takes time keeps its result, all else begins. Called before
  // the tick (NodeContext::tick_unreset).
  Unreset (*unreset)(NodeContext& context, NodeIndex self) = nullptr;
  // May be null: the same. Below a node with hold="between", in place of `tick`: keeps what its
  // progress is computed from up to date within the tick, and may look at the limit.
  Status (*tick_between)(NodeContext& context, NodeIndex self) = nullptr;
  // The kind in its place, or null: of a node with pace="true" or a member of such a barrier; and
  // of a leaf or a time that obeys, below one of those.
  const NodeKind* paced = nullptr;
  const NodeKind* committing = nullptr;  // of an action of a plugin with commit="true"
  const NodeKind* obeying = nullptr;
  // Of such a leaf that runs: how fast it is, of what it is alone. May be null.
  double (*taken_up)(NodeContext& context, NodeIndex self) = nullptr;
  // Of a node that paces: what it keeps of a child, by its number. May be null.
  const PacedChild* (*paced_child)(const RunView& run, NodeIndex self,
                                   std::uint32_t child) = nullptr;
  bool reads_entries = false;    // before each tick: its parameters are Tree::bound
  bool chooses_to_read = false;  // not before each tick: it calls reread where it needs them
  bool counts_writes = false;    // its first port names an entry whose Entry::writes it looks at
  // What it reads beside that, what it keeps itself, and the results and the progress of its
  // children. A state of a search keeps it for those that read it, and for nobody else, so one that
  // is missing here is a wrong proof: tests/property/fold_test.cpp.
  bool reads_own_hold = false;         // whether its last tick was withheld
  bool reads_hold_of_members = false;  // of a group: whether a synchronized parallel withheld them
  // Of a group: the statuses of its members and of all around them, also where a node around them
  // has ended.
  bool reads_ended_members = false;
  // A child behind the first may run and get no tick: what was held in it is so in the next tick,
  // too.
  bool passes_over_branches = false;
  // Whether equal children may change places (verify/symmetry.h).
  IfMoved if_moved = IfMoved::Differs;
  bool has_any_order = false;  // its children get their ticks whatever the others do
  // May be null. Of some of its children, so many have these statuses in its tick: whether it ends
  // in this tick whatever the others do. If so, all that its result depends on of these children;
  // what runs in them is halted at its end.
  std::optional<std::uint64_t> (*sure_to_end)(const NodeContext& context, NodeIndex self,
                                              const StatusCounts& of_some) = nullptr;
  // Of a node that asks a person, between two ticks: the answer, one of its options by its place,
  // of one who has seen the tick with this number. False: it did not ask then, or does not now. May
  // be null.
  bool (*answer)(NodeContext& context, NodeIndex self, std::uint32_t option,
                 std::uint32_t seen) = nullptr;
  // For views. Null if the child runs once. Called only while the node is Running.
  Round (*round)(NodeContext& context, NodeIndex self) = nullptr;
};

// For a kind that does not say it.
constexpr Unreset unreset_by(const NodeType& type) {
  const bool takes_time = type.category == NodeCategory::Action && type.can_run;
  return takes_time ? Unreset::KeepsResult : Unreset::Begins;
}

// The built-in kinds of a language, in the order in which they are documented.
inline std::span<const NodeKind* const> built_in_kinds(
    const LanguageRules& rules = kLockstepRules) {
  return rules.kinds;
}

// The kinds of all nodes of plugins.
extern const NodeKind kPluginAction;
extern const NodeKind kPluginCondition;
extern const NodeKind kPluginControl;  // also decorators
// The kinds of stand-ins for them.
extern const NodeKind kMockAction, kMockCondition, kMockControl, kMockDecorator;

}  // namespace lockstep::host

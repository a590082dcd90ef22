// A barrier beside the trees, and the nodes that wait at it for each other wherever they are. It
// holds as ParallelAbsolute and ParallelRelative do, from one snapshot before the root is ticked.
#include <algorithm>
#include <limits>
#include <utility>

#include "engine/bound_node.h"
#include "engine/groups.h"
#include "engine/nodes/barrier_list.h"
#include "engine/nodes/decorator.h"
#include "engine/nodes/fold.h"
#include "engine/nodes/pacing.h"

namespace lockstep::host {
namespace {

constexpr unsigned kBarrierDelta = 3;
constexpr unsigned kIdle = 4;
constexpr unsigned kBarrierPace = 6;

constexpr Parameter kBarrierParameters[] = {
    absolute::kBarriersParameter,
    absolute::kBarrierCountParameter,
    absolute::kAtBarrierParameter,
    Parameter{.name = "delta",
              .type = ValueType::Double,
              .doc = "Instead of barriers: how far a member may be ahead of the slowest and still "
                     "be ticked.",
              .range = {.min = 0, .max = 1}},
    Parameter{.name = "idle",
              .type = ValueType::String,
              .doc =
                  "What a member counts that does not run and has not succeeded: wait (0, so the "
                  "others wait for it at the first barrier) or ignore (nothing).",
              .default_text = "wait",
              .choices = kIdleChoices,
              .constant = true},
    kHoldParameter,
    pacing::kPace,
    pacing::kReaction};

std::optional<RuleBreak> rule_of_barrier(const ParameterValues& given) {
  if (auto broken = pacing::check(given, kBarrierPace)) return broken;
  return absolute::check_limits(given, kBarrierDelta);
}

// The state of the barrier. Behind it is the progress of each member (child_numbers), and what else
// is known of it.
struct BarrierState {
  SynchronizedState synchronized;
  std::uint64_t succeeded;  // how many members
};
static_assert(sizeof(BarrierState) % sizeof(double) == 0);

// Of one that paces. What it keeps of a member is the state of that.
struct PacedBarrierState {
  BarrierState barrier;
  Nanoseconds last;
};

// The history of a member since the common ancestor began its activation.
struct MemberState {
  bool succeeded;
  bool begun;
  bool held;  // in this tick
};

MemberState& member_state(NodeContext& context, NodeIndex barrier, std::uint32_t number) {
  const auto numbers = context.child_states<double>(barrier);
  return reinterpret_cast<MemberState*>(numbers.data() + numbers.size())[number];
}

NodeIndex parent_of(const NodeContext& context, NodeIndex node) {
  return context.tree().labels[node].parent;
}

// Whether no tick reaches a member that has begun and does not run again, in this activation of the
// ancestor, which runs: a parallel that runs has latched the child with the member, and itself
// cannot begin again. In doubt it can: a barrier that stays closed is seen and reported, one that
// opens for a member that comes back is a collision.
bool cannot_come_back(const NodeContext& context, NodeIndex member, NodeIndex ancestor) {
  NodeIndex child = member;
  while (context.status(parent_of(context, child)) != Status::Running) {
    child = parent_of(context, child);
  }
  if (!context.is_latched(child)) return false;
  for (NodeIndex node = parent_of(context, child); node != ancestor;
       node = parent_of(context, node)) {
    if (context.node(node).is_begun_once == 0) return false;
  }
  return true;
}

// A script has skipped the member, or a node around it.
bool is_skipped(const NodeContext& context, NodeIndex member, NodeIndex ancestor) {
  for (NodeIndex node = member; node != ancestor; node = parent_of(context, node)) {
    if (context.activity(node) == Activity::Skipped) return true;
  }
  return false;
}

// The number that a member counts as in the snapshot.
double reached(NodeContext& context, NodeIndex member, const MemberState& own, NodeIndex ancestor,
               double of_idle) {
  if (own.succeeded && !context.is_guard(member)) return 1.0;
  const Status status = context.status(member);
  if (status == Status::Running || status == Status::Success) return context.progress(member);
  if (is_skipped(context, member, ancestor)) return kLeftOut;
  if (own.begun && cannot_come_back(context, member, ancestor)) return 1.0;
  return status == Status::Idle ? of_idle : 0.0;
}

// The barrier succeeds with all of its members.
bool is_complete(NodeContext& context, NodeIndex self) {
  return context.state<BarrierState>(self).succeeded == context.node(self).children;
}

// Of a guard only the last result counts.
void note_result(NodeContext& context, const Member& member, MemberState& own, Status result) {
  const bool succeeded =
      result == Status::Success || (own.succeeded && !context.is_guard(member.node));
  if (std::exchange(own.succeeded, succeeded) == succeeded) return;
  BarrierState& state = context.state<BarrierState>(member.group);
  succeeded ? ++state.succeeded : --state.succeeded;
  context.groups().set_complete(member.group, is_complete(context, member.group));
}

// The progress of all members before the root is ticked.
struct Snapshot {
  double least;       // of those that are not left out
  bool runs = false;  // some member does
};

Snapshot take_snapshot(NodeContext& context, NodeIndex self) {
  const Tree& tree = context.tree();
  const bool ignores_idle = context.parameter(self, kIdle).integer == kIgnoresIdle;
  const double of_idle = ignores_idle ? kLeftOut : 0.0;
  const bool begins = context.status(self) == Status::Idle;
  const auto progress = context.child_states<double>(self);
  Snapshot snapshot{};
  for (const Member& it : tree.members_of(self)) {
    MemberState& own = member_state(context, self, it.number);
    if (begins) own = {};
    if (!begins && context.is_guard(it.node))
      note_result(context, it, own, context.status(it.node));
    progress[it.number] =
        begins ? of_idle : reached(context, it.node, own, tree.group(self).ancestor, of_idle);
    snapshot.runs |= context.status(it.node) == Status::Running;
  }
  snapshot.least = least_progress(progress);
  return snapshot;
}

void hold(NodeContext& context, NodeIndex self, double held_from) {
  const auto progress = context.child_states<double>(self);
  for (const Member& it : context.tree().members_of(self)) {
    MemberState& own = member_state(context, self, it.number);
    own.held = !own.succeeded && !context.is_guard(it.node) && progress[it.number] >= held_from;
  }
}

// The barrier at 0: no member begins until all have been reached, so they begin in one tick. A
// member that is not reached counts as 0 and does not run.
void hold_beginners(NodeContext& context, NodeIndex self) {
  const auto members = context.tree().members_of(self);
  const auto progress = context.child_states<double>(self);
  const bool all_reached = std::ranges::all_of(members, [&](const Member& it) {
    return context.status(it.node) == Status::Running || progress[it.number] != 0.0;
  });
  if (all_reached) return;
  for (const Member& it : members) {
    MemberState& own = member_state(context, self, it.number);
    const bool has_begun = context.status(it.node + 1) == Status::Running;
    own.held |= !own.succeeded && !context.is_guard(it.node) && !has_begun;
  }
}

// Finds the limit of this tick, and who is held.
void set_limit(NodeContext& context, NodeIndex self, double least) {
  auto& state = context.state<BarrierState>(self).synchronized;
  double& limit = state.limit;
  if (synchronization(context.node(self)) == Synchronization::Relative) {
    limit = context.parameter(self, kBarrierDelta).number;
    hold(context, self, least_above(least + limit));
  } else {
    const auto barriers = context.parameters().numbers(self, absolute::kBarriers);
    limit = absolute::current_barrier(barriers, least, state.place);
    const bool ticks = context.parameter(self, absolute::kAtBarrier).integer == kTicksAtBarrier;
    hold(context, self, absolute::held_from(limit, ticks));
    if (absolute::begins_at_zero(barriers)) hold_beginners(context, self);
  }
}

// While the limits are unknown.
void hold_nobody(NodeContext& context, NodeIndex self) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  context.state<BarrierState>(self).synchronized.limit = kNever;
  hold(context, self, kNever);
}

// Finds the factor of each member that runs. The member hands it down in its next tick.
void set_paces(NodeContext& context, NodeIndex self, double least) {
  const Tree& tree = context.tree();
  auto& state = context.state<PacedBarrierState>(self);
  const bool begins = context.status(self) == Status::Idle;
  const double last_limit = state.barrier.synchronized.limit;
  const double limit = farthest(synchronization(context.node(self)), last_limit, least);
  const pacing::Tick tick{.limit = limit,
                          .reaction = context.parameter(self, kBarrierPace + 1).number,
                          .given = kNoPace,
                          .seconds = begins ? 0.0 : to_seconds(context.now() - state.last)};
  const bool asks = limit <= std::numeric_limits<double>::max();
  const auto progress = context.child_states<double>(self);
  const std::uint32_t last_tick = context.tick_number() - 1;
  pacing::set_factors(context, tick, kNoPace, asks, [&](auto visit) {
    for (const Member& it : tree.members_of(self)) {
      if (context.is_guard(it.node)) continue;
      const MemberState& own = member_state(context, self, it.number);
      const NodeIndex child = it.node + 1;
      visit(pacing::Child{.node = child,
                          .reached = progress[it.number],
                          .is_in = !begins && !own.succeeded &&
                                   context.status(it.node) == Status::Running &&
                                   context.status(child) == Status::Running,
                          .was_ticked = context.run_state().last_tick[child] == last_tick,
                          .is_held = own.held},
            context.state<PacedChild>(it.node));
    }
  });
  state.last = context.now();
}

// An entry that has the limits is needed while a member runs. Before that the tree may write it.
template <bool kPaces>
Status tick_barrier(NodeContext& context, NodeIndex self) {
  BarrierState& state = context.state<BarrierState>(self);
  if (context.status(self) == Status::Idle) state = {};
  const Snapshot snapshot = take_snapshot(context, self);
  const bool readable =
      snapshot.runs ? reread(context, self) : context.parameters().read(self).empty();
  if (!readable && snapshot.runs) return give_up(context, self);
  if (readable) {
    set_limit(context, self, snapshot.least);
  } else {
    hold_nobody(context, self);
  }
  if constexpr (kPaces) set_paces(context, self, snapshot.least);
  return is_complete(context, self) ? Status::Success : Status::Running;
}

// A member that has succeeded or begun counts as long as the common ancestor runs.
void fold_barrier(NodeContext& context, NodeIndex self) {
  if (context.status(context.tree().group(self).ancestor) != Status::Running) {
    return fold::dead(context, self);
  }
  auto& state = context.state<BarrierState>(self).synchronized;
  state.limit = 0;
  state.place = 0;
  std::ranges::fill(context.child_states<double>(self), 0.0);
  for (const Member& it : context.tree().members_of(self)) {
    member_state(context, self, it.number).held = false;
  }
}

// --- the members ---------------------------------------------------------------------------------

constexpr Parameter kMemberParameters[] = {
    Parameter{.name = "barrier",
              .type = ValueType::String,
              .doc = "The barrier at which the child waits. An attribute of that name on a SubTree "
                     "gives another one inside.",
              .required = true,
              .constant = true,
              .group = "barrier"}};

template <bool kPaces>
Status tick_member(NodeContext& context, NodeIndex self) {
  const Member& member = context.tree().membership(self);
  const NodeIndex child = self + 1;
  context.groups().reach(member.group);
  MemberState& own = member_state(context, member.group, member.number);
  own.begun = true;
  if (context.status(member.group) == Status::Failure) {  // an entry has no value that it accepts
    context.halt_running_children(self);
    return Status::Failure;
  }
  if (own.held && context.hold(child)) return Status::Running;
  Status status{};
  if constexpr (kPaces) {
    // The larger of what comes from around it and of what its barrier asks: each of the two would
    // make strangers slow.
    PacedChild& pace = context.state<PacedChild>(self);
    pace.given = std::max(context.pace(), pace.asked);
    status = context.tick_at_pace(child, pace.given);
  } else {
    status = context.tick(child);
  }
  note_result(context, member, own, status);
  return status;
}

// A script has decided for it, so it has begun and ended; or it is skipped.
void member_decided(NodeContext& context, NodeIndex self, Status result) {
  const Member& member = context.tree().membership(self);
  MemberState& own = member_state(context, member.group, member.number);
  own.begun |= is_complete(result);
  note_result(context, member, own, result);
}

extern const NodeKind kPacedBarrier, kPacedMember;

}  // namespace

bool is_held_at_barrier(NodeContext& context, NodeIndex node) {
  const Member& member = context.tree().membership(node);
  return member_state(context, member.group, member.number).held;
}

bool has_passed_barrier(NodeContext& context, NodeIndex node) {
  const Member& member = context.tree().membership(node);
  return member_state(context, member.group, member.number).succeeded;
}

const NodeKind kBarrier{
    .type = {.id = "barrier",
             .category = NodeCategory::Group,
             .doc = "What each SyncProgress that names it waits for: a member that has reached the "
                    "current barrier, or is more than delta ahead, is held until all the others "
                    "have come so far.",
             .arity = {0, 0},
             .parameters = kBarrierParameters,
             .rule = rule_of_barrier,
             .sign = "‖",
             .synchronization = Synchronization::Absolute,
             .holding = {.barriers = absolute::kBarriers,
                         .at_barrier = absolute::kAtBarrier,
                         .delta = kBarrierDelta,
                         .idle = kIdle,
                         .hold = kIdle + 1}},
    .tick = tick_barrier<false>,
    .progress = [](NodeContext& context,
                   NodeIndex self) { return least_progress(context.child_states<double>(self)); },
    .state_size = sizeof(BarrierState),
    .state_per_child = sizeof(double) + sizeof(MemberState),
    .fold = fold_barrier,
    .paced = &kPacedBarrier,
    .chooses_to_read = true,
    .reads_ended_members = true};

const NodeKind kSyncProgress{
    .type = {.id = "SyncProgress",
             .category = NodeCategory::Decorator,
             .doc = "Its child waits at a barrier of the project for the children of all other "
                    "SyncProgress nodes of that barrier, wherever they are. Returns what its child "
                    "returns, and Running while the child is held.",
             .arity = {1, 1},
             .parameters = kMemberParameters,
             .begins_child_once = true},
    .tick = tick_member<false>,
    .progress = decorator::child_progress,
    .decided = member_decided,
    .paced = &kPacedMember};

namespace {

const NodeKind kPacedBarrier = [] {
  NodeKind kind = kBarrier;
  kind.tick = tick_barrier<true>;
  kind.state_size = sizeof(PacedBarrierState);
  kind.paced_child = [](const RunView& run, NodeIndex self, std::uint32_t child) {
    return &run.state<PacedChild>(run.tree().members_of(self)[child].node);
  };
  kind.paced = nullptr;
  return kind;
}();

const NodeKind kPacedMember = [] {
  NodeKind kind = kSyncProgress;
  kind.tick = tick_member<true>;
  kind.state_size = sizeof(PacedChild);
  kind.fold = fold::live;
  kind.paced = nullptr;
  return kind;
}();

}  // namespace

}  // namespace lockstep::host

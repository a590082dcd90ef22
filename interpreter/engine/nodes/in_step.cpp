// A robot in step with others: InStep holds its child at barriers, or by delta, until the other
// members of its team have come so far. Each member runs a tree of its own, on another machine, so
// a node stands for each of them: the leaves behind the child, which tree/expand adds. What they
// return is what was heard (team/team_plugin.h):
//   Running  the member does this round of the team, and its progress is that of the leaf
//   Skipped  it has not begun this round
//   Success  it has completed it
//   Failure  nothing is known of it now, so nobody moves: it is silent, or contradicts itself
//
// A child that has completed waits until all others have begun this round, which it ends: who comes
// later would join the next one, for which this robot may never come.
//
// The first tick of an activation only announces it. What others say of this round is looked at
// from the second one on, when they can know which round that is.
#include <algorithm>

#include "base/core/identifier.h"
#include "base/core/wording.h"
#include "engine/nodes/barrier_list.h"
#include "engine/nodes/decorator.h"
#include "engine/nodes/kinds.h"

namespace lockstep::host {
namespace in_step {
namespace {

constexpr unsigned kDelta = 3, kHold = 4, kGiveUp = 5, kTeamOfStep = 6, kAs = 7;

constexpr Parameter kInStepParameters[] = {
    absolute::kBarriersParameter,
    absolute::kBarrierCountParameter,
    absolute::kAtBarrierParameter,
    Parameter{.name = "delta",
              .type = ValueType::Double,
              .doc =
                  "Instead of barriers: how far the child may be ahead of the slowest member and "
                  "still be ticked.",
              .range = {.min = 0, .max = 1}},
    kHoldParameter,
    Parameter{.name = "give_up",
              .type = ValueType::Double,
              .doc = "After so long without a member that is heard, the child is halted, and the "
                     "node fails; it waits without limit when absent.",
              .unit = "s",
              .range = {.min = 0, .max = 1e9, .min_excluded = true}},
    Parameter{.name = "team",
              .type = ValueType::String,
              .doc = "The team, a <team> in root.",
              .required = true,
              .constant = true,
              .group = "team"},
    Parameter{.name = "as",
              .type = ValueType::String,
              .doc = "The member that this robot is.",
              .required = true,
              .constant = true}};
static_assert(kInStepParameters[kTeamOfStep].name == "team" && kInStepParameters[kAs].name == "as");

std::optional<RuleBreak> rule_of_in_step(const ParameterValues& given) {
  return absolute::check_limits(given, kDelta);
}

struct InStepState {
  SynchronizedState synchronized;
  Nanoseconds since;      // when some member was not heard any more
  std::uint64_t is_lost;  // 1: one is not
};
static_assert(sizeof(InStepState) % sizeof(double) == 0);

// What is known of the others in this tick.
struct Others {
  bool are_heard = true, have_begun = true;
};

// Not so of one that this process has not asked yet, after a cut.
bool was_heard(NodeContext& context, NodeIndex other) {
  return context.status(other) != Status::Failure && !context.leaf(other).was_cut();
}

// One that was not heard before this tick counts from the next one on: its progress is not known.
Others tick_others(NodeContext& context, NodeIndex self) {
  Others others;
  for (NodeIndex other = context.end_of(self + 1); other != context.end_of(self);
       other = context.end_of(other)) {
    if (context.status(other) == Status::Success) continue;  // it has completed this round
    const bool is_known = was_heard(context, other);
    const Status status = context.tick(other);
    others.are_heard &= is_known && status != Status::Failure;
    others.have_begun &= status == Status::Running || status == Status::Success;
  }
  return others;
}

// Before any of them is ticked: what was heard is of the time before the tick. A member that
// was not heard keeps its number: until it is heard, the child is held.
double take_snapshot(NodeContext& context, NodeIndex self) {
  const auto progress = context.child_states<double>(self);
  progress[0] = snapshot_of(context, self + 1);
  std::size_t place = 1;
  for (NodeIndex other = context.end_of(self + 1); other != context.end_of(self);
       other = context.end_of(other), ++place) {
    if (was_heard(context, other)) progress[place] = context.progress(other);
  }
  return least_progress(progress);
}

// Finds the limit of this tick. Returns the least progress that is held.
double set_limit(NodeContext& context, NodeIndex self, double least) {
  auto& state = context.state<InStepState>(self).synchronized;
  if (synchronization(context.node(self)) == Synchronization::Relative) {
    state.limit = context.parameter(self, kDelta).number;
    return least_above(least + state.limit);
  }
  const auto barriers = context.parameters().numbers(self, absolute::kBarriers);
  state.limit = absolute::current_barrier(barriers, least, state.place);
  const bool ticks = context.parameter(self, absolute::kAtBarrier).integer == kTicksAtBarrier;
  return absolute::held_from(state.limit, ticks);
}

// At a barrier at 0, members begin together.
bool waits_to_begin(NodeContext& context, NodeIndex self, const Others& others) {
  if (others.have_begun || context.status(self + 1) == Status::Running) return false;
  if (synchronization(context.node(self)) == Synchronization::Relative) return false;
  return absolute::begins_at_zero(context.parameters().numbers(self, absolute::kBarriers));
}

bool has_given_up(NodeContext& context, NodeIndex self, bool are_heard) {
  auto& state = context.state<InStepState>(self);
  const double most = context.parameter(self, kGiveUp).number;  // 0: there is none
  if (!are_heard && state.is_lost == 0) state.since = context.now();
  state.is_lost = are_heard ? 0 : 1;
  return most != 0 && !are_heard && context.passed(state.since) >= from_seconds(most);
}

Status begin(NodeContext& context, NodeIndex self) {
  context.state<InStepState>(self) = {};
  std::ranges::fill(context.child_states<double>(self), 0.0);
  set_limit(context, self, 0.0);
  return Status::Running;
}

Status tick_in_step(NodeContext& context, NodeIndex self) {
  if (context.first_tick(self)) return begin(context, self);
  const double least = take_snapshot(context, self);
  const Others others = tick_others(context, self);
  if (context.faulted()) return Status::Running;
  const double held_from = set_limit(context, self, least);
  const NodeIndex child = self + 1;
  if (has_given_up(context, self, others.are_heard)) {
    context.halt_running_children(self);
    std::uint32_t place = 0;
    context.say(self, place, "gave up: a member of the team was not heard for too long");
    return Status::Failure;
  }
  if (!others.are_heard) {
    std::uint32_t place = 0;
    context.say(self, place, "waits for a member of the team that is not heard");
  }
  const bool has_completed = context.status(child) == Status::Success;
  const bool is_held = !others.are_heard || waits_to_begin(context, self, others) ||
                       context.child_states<double>(self)[0] >= held_from;
  if (has_completed) {
    if (!others.are_heard || !others.have_begun) return Status::Running;
  } else if (is_held && !context.is_guard(child) && context.hold(child)) {
    return Status::Running;
  }
  const Status status = has_completed ? Status::Success : context.tick(child);
  if (status == Status::Success && !others.have_begun) {
    std::uint32_t place = 0;
    context.say(self, place, "its child has completed: waits for all members to begin");
    return Status::Running;
  }
  if (status != Status::Running && !context.faulted()) context.halt_running_children(self);
  return status;
}

void fold_in_step(NodeContext& context, NodeIndex self) {
  auto& state = context.state<InStepState>(self);
  const double most = context.parameter(self, kGiveUp).number;
  const bool counts = context.status(self) == Status::Running && most != 0 && state.is_lost != 0;
  state = {
      .synchronized = {},
      .since = counts ? -std::min(context.passed(state.since), from_seconds(most)) : Nanoseconds(0),
      .is_lost = counts ? 1u : 0u};
  std::ranges::fill(context.child_states<double>(self), 0.0);
}

// --- the team -----------------------------------------------------------------------------------

constexpr unsigned kMembers = 0;
constexpr std::size_t kMostMembers = 64, kLongestName = 64;

constexpr Parameter kTeamParameters[] = {
    Parameter{.name = "members",
              .type = ValueType::StringList,
              .doc = "The names of all robots that belong to it: left;right.",
              .required = true,
              .constant = true},
    Parameter{.name = "deadline",
              .type = ValueType::Double,
              .doc = "A member that is not heard for so long is silent, and all others hold; five "
                     "periods of the slowest member when absent.",
              .unit = "s",
              .range = {.min = 0, .max = 1e9, .min_excluded = true},
              .constant = true}};

std::optional<RuleBreak> rule_of_team(const ParameterValues& given) {
  const auto* members = std::get_if<std::vector<std::string>>(&given.values[kMembers]);
  if (members == nullptr) return std::nullopt;
  const auto broken = [](std::string message, std::string hint) {
    return RuleBreak{static_cast<int>(kMembers), std::move(message), std::move(hint)};
  };
  if (members->size() < 2)
    return broken("a team has at least two members", "members=\"left;right\"");
  if (members->size() > kMostMembers)
    return broken("a team has at most " + std::to_string(kMostMembers) + " members", "");
  for (auto it = members->begin(); it != members->end(); ++it) {
    const bool is_name = is_identifier(*it) && it->size() <= kLongestName;
    if (!is_name) {
      return broken("'" + brief(*it) + "' is not a name of a member",
                    "a name has letters, digits and _, and begins with no digit");
    }
    if (std::find(members->begin(), it, *it) != it)
      return broken("the member '" + brief(*it) + "' is given twice", "");
  }
  return std::nullopt;
}

}  // namespace
}  // namespace in_step

const NodeKind kInStep{
    .type = {.id = "InStep",
             .category = NodeCategory::Control,
             .doc =
                 "Keeps its child in step with the other members of a team, robots that run other "
                 "trees: at barriers, or at most delta ahead. Returns what its child returns, "
                 "and Running while the child is held, or has completed before all others have "
                 "begun.",
             .arity = {1, 1},
             .parameters = in_step::kInStepParameters,
             .rule = in_step::rule_of_in_step,
             .sign = "⇉T",
             .synchronization = Synchronization::Absolute,
             .holding = {.barriers = absolute::kBarriers,
                         .at_barrier = absolute::kAtBarrier,
                         .delta = in_step::kDelta,
                         .hold = in_step::kHold},
             .begins_child_once = true,
             .holds_first_child = true},
    .tick = in_step::tick_in_step,
    .progress = decorator::child_progress,
    .state_size = sizeof(in_step::InStepState),
    .state_per_child = sizeof(double),
    .fold = in_step::fold_in_step};

const NodeKind kTeam{
    .type = {.id = "team",
             .category = NodeCategory::Group,
             .doc = "Robots that do something in step, and run different trees: in each tree, one "
                    "InStep names the team and the member that the robot is.",
             .arity = {0, 0},
             .parameters = in_step::kTeamParameters,
             .rule = in_step::rule_of_team,
             .is_of_robots = true},
    .tick = nullptr,
    .progress = nullptr};

}  // namespace lockstep::host

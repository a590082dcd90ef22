// A barrier beside the trees, and the nodes that wait at it for each other wherever they are. It
// holds as ParallelAbsolute and ParallelRelative do, from one snapshot before the root is ticked.
#include <algorithm>

#include "engine/nodes/barrier_list.h"
#include "engine/nodes/decorator.h"

namespace lockstep {
namespace {

constexpr unsigned kBarrierDelta = 3;
constexpr unsigned kIdle = 4;

constexpr std::string_view kIdleChoices[] = {"wait", "ignore"};
constexpr std::int64_t kIgnore = 1;
constexpr double kLeftOut = std::numeric_limits<double>::quiet_NaN();

constexpr Parameter kBarrierParameters[] = {
    absolute::kBarriersParameter, absolute::kBarrierCountParameter, absolute::kAtBarrierParameter,
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
              .constant = true}};

std::optional<RuleBreak> rule_of_barrier(const ParameterValues& given) {
  const bool listed =
      given.is_given(absolute::kBarriers) || given.is_given(absolute::kBarrierCount);
  constexpr auto kOne = "give exactly one of 'barriers', 'barrier_count' and 'delta'";
  if (listed && given.is_given(kBarrierDelta)) {
    return RuleBreak{static_cast<int>(kBarrierDelta), "both barriers and 'delta' are given", kOne};
  }
  if (listed) return absolute::check_barriers(given);
  if (given.is_given(kBarrierDelta)) return std::nullopt;
  return RuleBreak{-1, "'barriers', 'barrier_count' or 'delta' is missing", kOne};
}

// Of the barrier; behind it the progress of each member (child_numbers), and its Place.
struct BarrierState {
  SynchronizedState synchronized;
  std::uint64_t succeeded;  // how many members
};
static_assert(sizeof(BarrierState) % sizeof(double) == 0);

// Of a member.
struct Place {
  bool succeeded;  // since the common ancestor began its activation
  bool held;       // in this tick
};

Place& place_of(Ticker& ticker, NodeIndex barrier, std::uint32_t number) {
  const auto numbers = ticker.child_numbers(barrier);
  return reinterpret_cast<Place*>(numbers.data() + numbers.size())[number];
}

// Whether no node will tick a member that has failed again, in this activation of the ancestor: a
// parallel keeps its result, or that of a node around it.
bool is_over(const Ticker& ticker, NodeIndex node, NodeIndex ancestor) {
  for (const Tree& tree = ticker.tree(); node != ancestor; node = tree.labels[node].parent) {
    if (is_complete(ticker.status(node)) && ticker.is_latched(node)) return true;
  }
  return false;
}

// A member that has failed for good is waited for by nobody, like such a child of a parallel, and
// one that was skipped in its last tick is left out.
double reached(Ticker& ticker, NodeIndex member, const Place& place, const Group& group) {
  if (place.succeeded && !ticker.is_guard(member)) return 1.0;
  if (ticker.activity(member) == Activity::Skipped) return kLeftOut;
  if (ticker.status(member) == Status::Failure && is_over(ticker, member, group.ancestor)) {
    return 1.0;
  }
  return ticker.progress(member);
}

// Returns the least progress of the members that are not left out.
double take_snapshot(Ticker& ticker, NodeIndex self, double of_idle) {
  const Tree& tree = ticker.tree();
  const Group& group = tree.groups[self - tree.nodes[0].end];
  const bool begins = ticker.status(self) == Status::Idle;
  const auto progress = ticker.child_numbers(self);
  for (const Member& it : tree.members_of(self)) {
    Place& place = place_of(ticker, self, it.number);
    if (begins) place = {};
    const bool is_idle = begins || (!place.succeeded && ticker.status(it.node) == Status::Idle);
    progress[it.number] = is_idle ? of_idle : reached(ticker, it.node, place, group);
  }
  return least_progress(progress);
}

template <class Held>
void hold(Ticker& ticker, NodeIndex self, Held held) {
  const auto progress = ticker.child_numbers(self);
  for (const Member& it : ticker.tree().members_of(self)) {
    Place& place = place_of(ticker, self, it.number);
    place.held = !place.succeeded && !ticker.is_guard(it.node) && held(progress[it.number]);
  }
}

Status tick_barrier(Ticker& ticker, NodeIndex self) {
  BarrierState& state = ticker.state<BarrierState>(self);
  if (ticker.status(self) == Status::Idle) state = {};
  const bool ignores_idle = ticker.parameter(self, kIdle).integer == kIgnore;
  const double least = take_snapshot(ticker, self, ignores_idle ? kLeftOut : 0);
  if (synchronization(ticker.node(self)) == Synchronization::Relative) {
    state.synchronized.limit = ticker.parameter(self, kBarrierDelta).number;
    const double most = least + state.synchronized.limit + kProgressEpsilon;
    hold(ticker, self, [most](double reached) { return reached > most; });
  } else {
    const auto barriers = ticker.numbers(ticker.parameter(self, absolute::kBarriers));
    state.synchronized.limit = absolute::current_barrier(barriers, least);
    const bool ticks =
        ticker.parameter(self, absolute::kAtBarrier).integer == absolute::kTickAtBarrier;
    hold(ticker, self, absolute::Held{state.synchronized.limit, ticks});
  }
  return state.synchronized.succeeded ? Status::Success : Status::Running;
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

void note_success(Ticker& ticker, const Member& member) {
  BarrierState& state = ticker.state<BarrierState>(member.group);
  bool& succeeded = place_of(ticker, member.group, member.number).succeeded;
  if (succeeded) return;
  succeeded = true;
  state.synchronized.succeeded = ++state.succeeded == ticker.node(member.group).children;
  if (state.synchronized.succeeded) ticker.complete(member.group);
}

Status tick_member(Ticker& ticker, NodeIndex self) {
  const Member& member = ticker.membership(self);
  const NodeIndex child = self + 1;
  ticker.reach(member.group);
  if (ticker.status(member.group) == Status::Failure) {  // an entry has no value that it accepts
    ticker.halt_running_children(self);
    return Status::Failure;
  }
  if (place_of(ticker, member.group, member.number).held) {
    if (ticker.activity(child) == Activity::Running) ticker.pause(child);
    return Status::Running;
  }
  const Status status = ticker.tick(child);
  if (status == Status::Success && !ticker.faulted()) note_success(ticker, member);
  return status;
}

}  // namespace

bool is_held_at_barrier(Ticker& ticker, NodeIndex node) {
  const Member& member = ticker.membership(node);
  return place_of(ticker, member.group, member.number).held;
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
             .synchronization = Synchronization::Absolute},
    .tick = tick_barrier,
    .progress = [](Ticker& ticker,
                   NodeIndex self) { return least_progress(ticker.child_numbers(self)); },
    .state_size = sizeof(BarrierState),
    .state_per_child = sizeof(double) + sizeof(Place)};

const NodeKind kSyncProgress{
    .type = {.id = "SyncProgress",
             .category = NodeCategory::Decorator,
             .doc = "Its child waits at a barrier of the project for the children of all other "
                    "SyncProgress nodes of that barrier, wherever they are. Returns what its child "
                    "returns, and Running while the child is held.",
             .arity = {1, 1},
             .parameters = kMemberParameters},
    .tick = tick_member,
    .progress = decorator::child_progress};

}  // namespace lockstep

#include "property/reference_barrier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

namespace lockstep::host::test {
namespace {

bool is_parallel_with_memory(const Plan& plan) {
  return plan.kind.starts_with("Parallel") && !plan.forgets;
}

// With what matters to a latched member: "Sequence with memory".
std::string described(const Plan& plan) {
  if (plan.kind.starts_with("Parallel")) {
    return plan.forgets ? "parallel without memory" : "parallel with memory";
  }
  if (plan.kind != "Sequence" && plan.kind != "Fallback") return plan.kind;
  return plan.kind + (plan.memory ? " with memory" : " without memory");
}

bool is_plain_condition(const Plan& plan) {
  return plan.children.empty() && is_guard(plan) && plan.hooks.empty();
}

}  // namespace

ReferenceBarrier::ReferenceBarrier(Reference& tree, const Plan& its_plan, ReferenceNode& root)
    : ReferenceGroup(tree, its_plan, root), members_(count()), pacer_(its_plan, count()) {}

void ReferenceBarrier::before_tick() {
  if (!ancestor().runs()) members_.assign(count(), {});
  snapshot.clear();
  for (std::size_t place = 0; place < count(); ++place) {
    const bool is_latched = !is_guard(member(place).plan);  // a guard is "never latched"
    members_[place].has_succeeded &= is_latched || member(place).status == Status::Success;
    snapshot.push_back(counted(place));
    note_counted(place, snapshot.back());
  }
  for (Member& it : members_) it.is_held = false;
  // "A limit in an entry is read while a member runs, and only then."
  if (somebody_runs()) {
    limit_ = limit();
    for (std::size_t place = 0; place < count(); ++place) hold(place, *limit_);
  } else {
    read_limit();
  }
  if (begins_together()) hold_beginners();
  if (plan.pace) pace();
  status = all_succeeded() ? Status::Success : Status::Running;
}

// e of the law.
double ReferenceBarrier::counted(std::size_t place) {
  ReferenceNode& it = member(place);
  const Member& kept = members_[place];
  // C begins an activation in this tick, if it is ticked at all: nobody has begun.
  if (!ancestor().runs()) return idle();
  // "e = 1 once the member succeeded, latched until C begins an activation"
  if (kept.has_succeeded && !is_guard(it.plan)) return 1;
  // "e = the child's progress while the member runs, also while it is held"
  if (it.runs()) return it.child().progress();
  // A guard is "never latched": its last result counts.
  if (it.status == Status::Success) return 1;
  // "Skipped, the member or a node above it below C: left out until it runs again"
  if (is_left_out(place)) return kLeftOut;
  // "One exception: e = 1 for a member that was begun in this activation of C, is not Running, and
  // cannot come back"
  if (kept.was_begun && cannot_come_back(place)) return 1;
  // "Idle: 0 (wait) or left out (ignore). Failed: 0 with both."
  return it.status == Status::Failure ? 0 : idle();
}

// Until it runs, "or what is around it begins again" (docs/nodes-and-attributes.md): then the
// others wait for it as for any idle member.
bool ReferenceBarrier::is_left_out(std::size_t place) const {
  const Way& nodes = way(place);
  const auto below_ancestor = nodes.begin() + static_cast<std::ptrdiff_t>(ancestor_depth()) + 1;
  return std::any_of(below_ancestor, nodes.end(),
                     [](const auto* node) { return node->status == Status::Skipped; });
}

// "a parallel P with memory, C or below C, is Running and has latched (with Success or Failure) the
// child that holds the member"
bool ReferenceBarrier::cannot_come_back(std::size_t place) const {
  const Way& nodes = way(place);
  for (std::size_t i = ancestor_depth(); i + 1 < nodes.size(); ++i) {
    const ReferenceNode &parallel = *nodes[i], &child = *nodes[i + 1];
    if (!is_parallel_with_memory(parallel.plan) || !parallel.runs()) continue;
    const bool is_latched = is_complete(child.status) && !is_guard(child.plan);
    if (!is_latched) continue;
    const std::string why = doubt(place, i);
    if (why.empty()) return note_gone(place, i), true;
    note("in doubt, a member comes back: " + why);
  }
  return false;
}

// Why P may begin again, or "".
std::string ReferenceBarrier::doubt(std::size_t place, std::size_t parallel) const {
  const Way& nodes = way(place);
  // "if P is below C, no node from P up to the one below C has a `while`"
  for (std::size_t i = ancestor_depth() + 1; i <= parallel; ++i) {
    if (nodes[i]->plan.hooks.contains("while")) return "a while";
  }
  // "and each node above P, up to and including C, is Running and is one of: …"
  for (std::size_t i = ancestor_depth(); i < parallel; ++i) {
    const bool goes_on = nodes[i]->runs() && never_begins_again(*nodes[i], *nodes[i + 1]);
    if (!goes_on) return "below a " + described(nodes[i]->plan);
  }
  return "";
}

bool ReferenceBarrier::never_begins_again(const ReferenceNode& node,
                                          const ReferenceNode& below) const {
  // "a parallel, Sequence or Fallback with memory"
  if (is_parallel_with_memory(node.plan)) return true;
  const bool is_ordered = node.plan.kind == "Sequence" || node.plan.kind == "Fallback";
  if (is_ordered && node.plan.memory) return true;
  // "or a Sequence or Fallback without memory in whose last child P is and before which only plain
  // conditions stand"
  if (is_ordered) {
    const auto& all = node.plan.children;
    return &all.back() == &below.plan &&
           std::all_of(all.begin(), all.end() - 1, is_plain_condition);
  }
  // IfThenElse, but not its condition: if the branch after that is Skipped, so is the IfThenElse,
  // which a parallel then begins again.
  if (node.plan.kind == "IfThenElse") return &below.plan != &node.plan.children.front();
  constexpr std::array kOthers{"Inverter", "ForceSuccess", "ForceFailure", "Timeout", "Delay",
                               "RunOnce",  "SyncProgress", "UseResources", "SubTree"};
  return std::ranges::find(kOthers, node.plan.kind) != kOthers.end();
}

ProgressLimit ReferenceBarrier::limit() const {
  try {
    return {plan, world.entries};
  } catch (const ProgressLimit::BadEntry&) {
    note("a limit in an entry is wrong while a member runs");
    throw ReferenceFault{number};
  }
}

void ReferenceBarrier::read_limit() {
  limit_.reset();
  try {
    limit_ = ProgressLimit(plan, world.entries);
  } catch (const ProgressLimit::BadEntry&) {
    note("a limit in an entry is wrong while no member runs");
  }
}

bool ReferenceBarrier::is_reached_between(const ReferenceNode& node,
                                          const std::function<double()>& progress) const {
  if (!plan.holds_between || members_[place_of(node)].has_succeeded) return false;
  const double reached = progress();
  return limit_ && limit_->holds(reached, least_of(snapshot));
}

bool ReferenceBarrier::somebody_runs() const {
  for (std::size_t place = 0; place < count(); ++place) {
    if (member(place).runs()) return true;
  }
  return false;
}

// "A member that is begun again after a success is neither held nor counted below 1: it has
// passed."
void ReferenceBarrier::hold(std::size_t place, const ProgressLimit& limit) {
  const bool has_passed = members_[place].has_succeeded;
  if (!member(place).runs() || is_guard(member(place).plan)) return;
  if (has_passed) return note("a member passes after its success");
  members_[place].is_held = limit.holds(snapshot[place], least_of(snapshot));
  if (members_[place].is_held) note_held(place);
}

// While no member runs, a limit that cannot be read holds nobody.
bool ReferenceBarrier::begins_together() const {
  try {
    return ProgressLimit(plan, world.entries).begins_together();
  } catch (const ProgressLimit::BadEntry&) {
    return false;
  }
}

// "A member whose child has not begun is held, unless at the start of the tick all members have
// been reached: they run (held or not), have passed (e = 1), or are left out"
void ReferenceBarrier::hold_beginners() {
  for (std::size_t place = 0; place < count(); ++place) {
    if (!member(place).runs() && snapshot[place] == 0) return hold_all_that_have_not_begun();
  }
  note("all members begin");
}

void ReferenceBarrier::hold_all_that_have_not_begun() {
  for (std::size_t place = 0; place < count(); ++place) {
    ReferenceNode& it = member(place);
    if (is_guard(it.plan) || members_[place].has_succeeded || it.child().runs()) continue;
    members_[place].is_held = true;
    if (it.runs()) note("a member waits to begin");
  }
}

// Who begins in this tick, or cannot be read, asks for nothing but speed.
void ReferenceBarrier::pace() {
  std::optional<ProgressLimit> limit;
  try {
    limit.emplace(plan, world.entries);
  } catch (const ProgressLimit::BadEntry&) {
  }
  std::vector<ReferencePacer::Child> all;
  const bool begins = !ancestor().runs();
  for (std::size_t place = 0; place < count(); ++place) {
    ReferenceNode& it = member(place);
    const Member& kept = members_[place];
    all.push_back({.node = &it.child(),
                   .reached = snapshot[place],
                   .takes_part = !begins && !kept.has_succeeded && it.runs() && it.child().runs(),
                   .was_ticked = it.child().last_tick + 1 == world.tick,
                   .is_held = kept.is_held,
                   .is_guard = is_guard(it.plan)});
  }
  const double farthest =
      limit ? limit->farthest(least_of(snapshot)) : std::numeric_limits<double>::infinity();
  pacer_.tick(all, farthest, std::isfinite(farthest), kNothingAsked, world.now, begins);
  for (std::size_t place = 0; place < count(); ++place) {
    if (all[place].takes_part && pacer_.told(place) < 1) note("a member is slowed");
  }
}

// A tick begins its activation, if that has not begun.
void ReferenceBarrier::reach(const ReferenceNode& member) {
  last_tick = world.tick;
  Member& it = members_[place_of(member)];
  if (it.has_failed && !member.runs()) note("a failed member comes back");
  if (it.has_failed && it.is_held) note("a failed member waits to begin again");
  it.was_begun = true;
}

void ReferenceBarrier::was_ticked(const ReferenceNode& node) {
  if (!has_member(node)) return;
  Member& it = members_[place_of(node)];
  if (it.is_gone) note(kGoneComesBack);
  if (is_complete(node.status)) it.was_begun = true;  // also when a script has decided for it
  it.has_failed = node.status == Status::Failure;
  if (node.status == Status::Success) it.has_succeeded = true;
  // "never latched"
  if (is_guard(node.plan)) it.has_succeeded = node.status == Status::Success;
  status = all_succeeded() ? Status::Success : Status::Running;
}

void ReferenceBarrier::note_held(std::size_t place) const {
  note("a member is held");
  if (plan.ignores_idle) note("a member is held at a barrier that ignores who is idle");
  for (const auto& [parameter, key] : plan.from_entries) {
    note("a member is held by an entry: " + parameter);
  }
  const Way& nodes = way(place);
  for (std::size_t i = ancestor_depth(); i + 1 < nodes.size(); ++i) {
    note("a member is held below a " + nodes[i]->plan.kind);
  }
}

// P is so deep on the way to the member.
void ReferenceBarrier::note_gone(std::size_t place, std::size_t parallel) const {
  const bool has_failed = member(place).status == Status::Failure;
  note(has_failed ? "a failed member cannot come back" : "a halted member cannot come back");
  const std::string what = "a member cannot come back: ";
  if (parallel == ancestor_depth()) note(what + "the common ancestor has latched it");
  for (std::size_t i = ancestor_depth(); i < parallel; ++i) {
    note(what + "below a " + described(way(place)[i]->plan));
  }
}

void ReferenceBarrier::note_counted(std::size_t place, double progress) {
  const ReferenceNode& it = member(place);
  Member& kept = members_[place];
  if (!ancestor().runs() || it.runs() || (kept.has_succeeded && !is_guard(it.plan))) return;
  const bool is_one = progress == 1;
  if (it.status != Status::Success) kept.is_gone |= is_one;
  if (is_guard(it.plan)) {
    if (is_one) note("a guard is a member: it counts 1");
    if (it.status == Status::Failure && !is_one) note("a guard is a member: it counts 0");
  } else if (it.status == Status::Failure && !is_one) {
    note("a failed member counts 0");
  } else if (it.status == Status::Skipped) {
    note("a skipped member is left out");
  } else if (is_left_out(place)) {
    note("a member is left out below a node that was skipped");
  } else if (!is_one) {
    note(progress == 0 ? "a member is idle: the others wait" : "a member is idle: it is ignored");
  }
}

void ReferenceBarrier::keep(KeptState& state) {
  ReferenceNode::keep(state);
  for (Member& it : members_) {
    state(it.was_begun, it.has_succeeded, it.is_held, it.has_failed, it.is_gone);
  }
}

bool ReferenceBarrier::all_succeeded() const {
  return std::ranges::all_of(members_, &Member::has_succeeded);
}

// "Held: the child is paused, the member returns Running; else it ticks the child and returns its
// status."
Status SyncProgress::on_tick(bool) {
  barrier().reach(*this);
  // "A member of a barrier is given the larger of what comes from around it and of what its barrier
  // asks."
  if (!is_held()) return child().tick_at_pace(std::max(world.given, barrier().pace_of(*this)));
  child().pause();
  return Status::Running;
}

ReferenceBarrier& SyncProgress::barrier() const {
  for (ReferenceGroup* group : world.groups) {
    auto* barrier = dynamic_cast<ReferenceBarrier*>(group);
    if (barrier != nullptr && barrier->has_member(*this)) return *barrier;
  }
  throw std::logic_error("a SyncProgress without a barrier");
}

}  // namespace lockstep::host::test

#include "verify/team/searched_robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/core/resource_set.h"
#include "engine/synchronized.h"

namespace lockstep::host {
namespace {

// What shortens a search of one tree looks at that alone, and not at what a tick changes here.
constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();
const Symmetry kNoneAlike;

}  // namespace

SearchedRobot::SearchedRobot(const Tree& tree, const LeafModels& models,
                             std::span<const Property> properties, const TeamNames& names,
                             std::size_t number, double rate)
    : tree_(tree),
      team_(tree, names.teams, TeamCode::run_of(number), transport_, clock_),
      leaves_(tree.leaves.size()),
      stepper_(tree, models, properties, rate, kNoneAlike, false, kNever, kNever),
      moments_(tree, team_.asked()),
      moved_(names.teams.size()) {
  for (const RobotLeaf& it : robot_leaves(tree)) {
    TeamRun::Team& team = *team_.team(it.team);
    const TeamDeclaration& declaration = team.member.declaration();
    Leaf& leaf = leaves_[it.leaf];
    leaf = {.team = &team, .asks = it.asks, .place = it.place};
    const auto other = std::ranges::find(declaration.others, it.other);
    leaf.other = static_cast<std::size_t>(other - declaration.others.begin());
    if (it.wanted)
      leaf.wanted = all_resources(resource_list(*it.wanted, declaration.resources).request());
  }
  for (const TeamRun::Team& team : team_.teams()) {
    auto& in_step = in_step_.emplace_back();
    if (!team.node) continue;
    const auto list = barriers(tree, *team.node);
    in_step = InStep{.node = *team.node, .barriers = {}, .ticks_at_barrier = false};
    if (!list) continue;
    in_step->barriers.assign(list->begin(), list->end());
    if (has_barrier_at_zero(tree, *team.node)) in_step->barriers.push_back(0);
    in_step->ticks_at_barrier = ticks_at_barrier(tree, *team.node);
  }
  stepper_.leaves().set_outside(*this);
  first_tree_ = trees_.add(stepper_.first_state()).first;
}

void SearchedRobot::begin_turn(const RobotState& from, bool begins,
                               std::span<const HeardWord> heard) {
  from_ = from;
  if (begins) from_.tree = first_tree_;
  for (std::size_t i = 0; i < from_.teams.size(); ++i) {
    team_.teams()[i].member.restore(from_.teams[i].member);
    team_.teams()[i].pool.restore(from_.teams[i].pool);
  }
  transport_.given.assign(heard.begin(), heard.end());
  team_.before_tick({}, 0, Nanoseconds(0));
  heard_.clear();
  pools_.clear();
  for (std::size_t i = 0; i < from_.teams.size(); ++i) {
    const TeamRun::Team& team = team_.teams()[i];
    heard_.push_back(team.member.memory());
    pools_.push_back(team.pool.memory());
    moved_[i].round = team.member.round();
  }
  stepper_.load(trees_[from_.tree], begins);
}

RobotState SearchedRobot::tick() {
  for (std::size_t i = 0; i < heard_.size(); ++i) {
    team_.teams()[i].member.restore(heard_[i]);
    team_.teams()[i].pool.restore(pools_[i]);
  }
  const Status status = stepper_.tick();
  const Moment& moment = moments_.after_tick(stepper_.ticker(), 0, Nanoseconds(0));
  for (std::size_t i = 0; i < in_step_.size(); ++i) {
    if (!in_step_[i]) continue;
    const NodeIndex node = in_step_[i]->node;
    moved_[i].runs = moment.status(node) == Status::Running;
    moved_[i].ticked = moment.ticked(node + 1);
    moved_[i].from = moment.used(node)[0];
  }
  team_.after_tick(moment, {.tick = 0, .time = Nanoseconds(0), .status = status});
  const bool ends = status != Status::Running || stepper_.ticker().faulted();
  if (ends) team_.run_ended(moment, {});
  RobotState after = from_;
  after.phase = !ends                         ? RobotState::Phase::Running
                : stepper_.ticker().faulted() ? RobotState::Phase::Faulted
                : status == Status::Success   ? RobotState::Phase::Succeeded
                : status == Status::Skipped   ? RobotState::Phase::Skipped
                                              : RobotState::Phase::Failed;
  for (std::size_t i = 0; i < after.teams.size(); ++i) {
    TeamPart& part = after.teams[i];
    const TeamRun::Team& team = team_.teams()[i];
    part.member = team.member.memory();
    part.pool = team.pool.memory();
    const TeamWord& own = part.member.own;
    if (!own.is_in) continue;
    if (part.round != own.round) part.reached = 0;
    part.round = own.round;
    part.reached = std::max(part.reached, own.progress);
  }
  if (!ends) after.tree = trees_.add(stepper_.fold()).first;
  after.said.insert(after.said.begin(), transport_.said);
  after.said.pop_back();
  return after;
}

std::string SearchedRobot::why() {
  const Moment& moment = moments_.now(stepper_.ticker());
  team_.run_ended(moment, {});
  if (!team_.why().empty()) return team_.why();
  for (std::size_t i = 0; i < in_step_.size(); ++i) {
    if (!moved_[i].runs || moved_[i].ticked) continue;
    const TeamMember& member = team_.teams()[i].member;
    for (std::size_t other = 0; other < member.declaration().others.size(); ++other) {
      const TeamMember::Known& known = member.known(other);
      const std::string& name = member.declaration().others[other];
      if (known.where == TeamMember::Where::NotBegun)
        return fmt::format("waits for '{}', which has not begun", name);
      if (known.progress < moved_[i].from)
        return fmt::format("waits for '{}', which is at {}", name, known.progress);
    }
  }
  return "";
}

void SearchedRobot::start(std::uint32_t leaf) {
  const Leaf& it = leaves_[leaf];
  if (it.asks) it.team->pool.give_back(it.place);
}

Status SearchedRobot::tick(std::uint32_t leaf) {
  const Leaf& it = leaves_[leaf];
  return it.asks ? it.team->tick_asking(it.place, it.wanted) : it.team->tick_robot(it.other);
}

double SearchedRobot::progress(std::uint32_t leaf) const {
  const Leaf& it = leaves_[leaf];
  return it.asks ? 0.0 : it.team->member.known(it.other).progress;
}

}  // namespace lockstep::host

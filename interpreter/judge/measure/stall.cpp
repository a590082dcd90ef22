#include "judge/measure/stall.h"

#include <algorithm>
#include <utility>

#include "base/core/resource_set.h"

namespace lockstep::host {
namespace {

constexpr double kNoChange = 1e-9;

// The last link that is of no pool: what it waits for keeps all others waiting. There is one.
std::size_t last_synchronized(const Shape& shape, const WaitChain& chain) {
  std::size_t last = chain.links.size() - 1;
  while (shape.nodes[chain.links[last].node].is_pool()) --last;
  return last;
}

}  // namespace

void StallDetector::after_tick(const SynchronizedTick& tick, bool holds_somebody) {
  const Nanoseconds passed = tick.time - std::exchange(last_, tick.time);
  if (!tick.ticked) {
    runs_ = runs_ && tick.status == Status::Running;  // else it was halted
    stands_ = false;
    since_ += passed;
    return;
  }
  const double least = least_progress(tick.used);
  const bool is_new = !runs_ || least > best_ + kNoChange || least >= 1 - kNoChange;
  runs_ = tick.status == Status::Running;
  if (is_new) {
    best_ = least;
    has_waited_ = false;
  }
  stands_ = runs_ && holds_somebody;
  if (!stands_ || std::exchange(has_waited_, true)) return;
  since_ = tick.time;
  ++number_;
}

StandingNodes::StandingNodes(const Shape& shape, Nanoseconds limit) : shape_(shape), limit_(limit) {
  for (const NodeIndex node : synchronized_nodes(shape)) {
    if (compares_progress(shape.nodes[node].synchronization)) {
      nodes_.push_back({.ticks = SynchronizedTicks(shape, node, false)});
      continue;
    }
    for (const NodeIndex child : shape.nodes[node].members)
      users_.push_back({.pool = node, .user = child - 1});
  }
}

void StandingNodes::after_tick(const Moment& moment) {
  for (Standing& it : nodes_) {
    const SynchronizedTick tick = it.ticks.read(moment);
    it.detector.after_tick(tick, tick.ticked && holds_somebody(shape_, moment, it.node()));
  }
  for (Waiting& it : users_) {
    const bool waits =
        moment.status(it.user) == Status::Running && host::waits(moment.limit(it.user));
    if (std::exchange(it.waits, waits) == waits) continue;
    it = {.pool = it.pool, .user = it.user, .waits = waits, .since = moment.time};
  }
}

std::optional<Standstill> StandingNodes::circle_of_pools(const Moment& moment, Nanoseconds now) {
  for (Waiting& it : users_) {
    if (!is_over(it, now)) continue;
    it.next_look = now + limit_;
    if (auto circle = circle_at(moment, it, now)) return circle;
  }
  return std::nullopt;
}

// One that has a synchronized node in it is that node's to report. It stands since its last member
// waits.
std::optional<Standstill> StandingNodes::circle_at(const Moment& moment, Waiting& at,
                                                   Nanoseconds now) {
  if (lasting_owners(shape_, moment, at.user).empty()) return std::nullopt;
  Standstill found{.chain = wait_chain(shape_, moment, {at.pool, at.user}), .time = now};
  if (!found.is_circle()) return std::nullopt;
  std::vector<Waiting*> members;
  for (const WaitLink& link : found.chain.links) {
    const auto it = std::ranges::find(users_, link.waiting, &Waiting::user);
    if (it == users_.end() || !shape_.nodes[link.node].is_pool()) return std::nullopt;
    found.since = std::max(found.since, it->since);
    members.push_back(&*it);
  }
  if (now - found.since <= limit_) return std::nullopt;
  const bool is_known = std::ranges::all_of(members, &Waiting::is_told);
  for (Waiting* it : members) it->is_told = true;
  at.is_told = true;
  return is_known ? std::nullopt : std::optional(std::move(found));
}

StandingNodes::Standing* StandingNodes::find(NodeIndex node) {
  const auto it = std::ranges::find(nodes_, node, &Standing::node);
  return it == nodes_.end() ? nullptr : &*it;
}

Standstill StandingNodes::standstill(const Moment& moment, const Standing& at, Nanoseconds now) {
  Standstill found{.chain = wait_chain(shape_, moment, at.node()), .time = now};
  if (found.is_circle()) {
    describe_circle(found);
  } else {
    describe_chain(found, at);
  }
  return found;
}

// It stands since its last node does. One of pools alone is circle_of_pools' to report.
void StandingNodes::describe_circle(Standstill& circle) {
  bool is_of_pools = true;
  for (std::size_t place = 0; place < circle.chain.links.size(); ++place) {
    const Standing* const it = find(circle.chain.links[place].node);
    if (it == nullptr) continue;
    is_of_pools = false;
    circle.is_old = circle.is_old && it->is_over(limit_, circle.time);
    if (it->detector.since() < circle.since) continue;
    circle.head = place;
    circle.since = it->detector.since();
    circle.best = it->detector.best();
  }
  circle.is_old = circle.is_old && !is_of_pools;
}

// The node that is to blame may be slow instead of standing still.
void StandingNodes::describe_chain(Standstill& found, const Standing& at) {
  const std::size_t last = last_synchronized(shape_, found.chain);
  const Standing& to_blame = *find(found.chain.links[last].node);
  found.is_old = to_blame.is_over(limit_, found.time);
  found.head = found.is_old ? last : 0;
  const StallDetector& head = (found.is_old ? to_blame : at).detector;
  found.since = head.since();
  found.best = head.best();
}

StallWatch::StallWatch(const Shape& shape, Nanoseconds limit, Report report)
    : nodes_(shape, limit), report_(std::move(report)) {}

void StallWatch::after_tick(const Moment& moment) {
  nodes_.after_tick(moment);
  for (StandingNodes::Standing& it : nodes_.all()) {
    if (!it.is_over(nodes_.limit(), moment.time) || moment.time < it.next_look) continue;
    if (it.told_as_circle != it.detector.number()) look(moment, it);
  }
  while (const auto circle = nodes_.circle_of_pools(moment, moment.time)) report_(*circle);
}

// The youngest node of a circle reports it, and of a chain the one that is to blame. If that comes
// on, only slowly, the chain is reported as it is.
void StallWatch::look(const Moment& moment, Standing& at) {
  const Standstill found = nodes_.standstill(moment, at, moment.time);
  const std::uint64_t number = at.detector.number();
  at.next_look = moment.time + nodes_.limit();
  if (at.told == number && !found.is_circle()) return;
  if (!found.is_old && (found.is_circle() || std::exchange(at.put_off, number) != number)) return;
  const auto told = found.is_circle() ? &Standing::told_as_circle : &Standing::told;
  const Standing& head = *nodes_.find(found.link().node);
  const bool is_known = head.*told == head.detector.number();
  at.told = at.*told = number;
  for (const WaitLink& link : found.chain.links) {
    Standing* const it = nodes_.find(link.node);
    if (it == nullptr || !it->detector.stands()) continue;
    it->told = (*it).*told = it->detector.number();
  }
  if (!is_known) report_(found);
}

}  // namespace lockstep::host

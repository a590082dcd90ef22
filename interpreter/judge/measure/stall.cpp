#include "judge/measure/stall.h"

#include <algorithm>
#include <utility>

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
    if (!compares_progress(shape.nodes[node].synchronization)) continue;
    nodes_.push_back({.ticks = SynchronizedTicks(shape, node, false)});
  }
}

void StandingNodes::after_tick(const Moment& moment) {
  for (Standing& it : nodes_) {
    const SynchronizedTick tick = it.ticks.read(moment);
    it.detector.after_tick(tick, tick.ticked && holds_somebody(shape_, moment, it.node()));
  }
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

// It stands since its last node does.
void StandingNodes::describe_circle(Standstill& circle) {
  for (std::size_t place = 0; place < circle.chain.links.size(); ++place) {
    const Standing* const it = find(circle.chain.links[place].node);
    if (it == nullptr) continue;
    circle.is_old = circle.is_old && it->is_over(limit_, circle.time);
    if (it->detector.since() < circle.since) continue;
    circle.head = place;
    circle.since = it->detector.since();
    circle.best = it->detector.best();
  }
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

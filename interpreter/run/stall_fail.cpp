#include "run/stall_fail.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/resources.h"
#include "engine/ticker.h"
#include "run/shape_of.h"

namespace lockstep::host {
namespace {

NodeIndex lowest_above(const Tree& tree, NodeIndex one, NodeIndex other) {
  const auto contains = [&](NodeIndex node) {
    return node <= other && other < tree.nodes[node].end;
  };
  while (!contains(one)) one = tree.labels[one].parent;
  return one;
}

// The lowest node that has all of it inside. Of a pool only those that wait for each other count.
NodeIndex place_of(const Tree& tree, const WaitLink& link) {
  if (is_pool(tree, link.node)) return lowest_above(tree, link.waiting, link.awaited);
  return tree.is_group(link.node) ? tree.group(link.node).ancestor : link.node;
}

// The progress that a child of a node will count with. Nothing if a member of a barrier has
// completed in the last tick: the next tick shows it.
std::optional<double> progress_now(Ticker& ticker, NodeIndex node, NodeIndex child) {
  if (!ticker.tree().is_group(node)) return snapshot_of(ticker, child);
  const NodeIndex member = child - 1;
  const bool is_known =
      ticker.status(member) == Status::Running || !ticker.ticked(member) || ticker.is_guard(member);
  return is_known ? std::optional(ticker.progress(member)) : std::nullopt;
}

}  // namespace

NodeIndex stalled_node(const Tree& tree, const Standstill& standstill) {
  if (!standstill.is_circle()) return place_of(tree, standstill.link());
  NodeIndex node = place_of(tree, standstill.link());
  for (const WaitLink& link : standstill.chain.links) {
    node = lowest_above(tree, node, place_of(tree, link));
  }
  return node;
}

StallFail::StallFail(const Tree& tree, Nanoseconds limit, Report report)
    : tree_(tree),
      shape_(shape_of(tree)),
      moments_(tree),
      nodes_(shape_, limit),
      report_(std::move(report)) {}

void StallFail::before_tick(Ticker& ticker, Nanoseconds now) {
  orders_.clear();
  if (ticker.held(0)) return;  // somebody paused the run, so it does not show what holds what
  for (Standing& it : nodes_.all()) {
    if (it.is_over(nodes_.limit(), now) && now >= it.next_look) look(ticker, it, now);
  }
  while (auto circle = nodes_.circle_of_pools(moments_.now(ticker), now)) {
    order(ticker, std::move(*circle));
  }
}

void StallFail::look(Ticker& ticker, Standing& at, Nanoseconds now) {
  if (comes_on(ticker, at)) return;
  Standstill found = nodes_.standstill(moments_.now(ticker), at, now);
  if (!is_due(found, at.node())) {
    at.next_look = now + nodes_.limit();
    return;
  }
  if (found.is_circle() && comes_on(ticker, found)) return;
  order(ticker, std::move(found));
}

void StallFail::order(Ticker& ticker, Standstill found) {
  const NodeIndex node = stalled_node(tree_, found);
  if (std::ranges::find(orders_, node, &Order::node) != orders_.end()) return;
  ticker.fail_next(node);
  orders_.push_back({std::move(found), node});
}

// A circle is due with its youngest node. What waits for another node leaves the matter to that.
bool StallFail::is_due(const Standstill& found, NodeIndex node) {
  return found.is_old && (found.is_circle() || found.link().node == node);
}

bool StallFail::comes_on(Ticker& ticker, const Standstill& circle) {
  return std::ranges::any_of(circle.chain.links, [&](const WaitLink& link) {
    Standing* const it = nodes_.find(link.node);
    return it != nullptr && comes_on(ticker, *it);
  });
}

// Whether the node will find a new best in its next tick: in the last one, the children moved after
// it had looked.
bool StallFail::comes_on(Ticker& ticker, Standing& at) {
  const double most = at.detector.best() + kProgressEpsilon;
  const auto progress = child_progress(ticker, at.node());
  const auto children = at.ticks.children();
  bool is_in_doubt = false;
  for (std::size_t number = 0; number < children.size(); ++number) {
    if (!(progress[number] <= most)) continue;  // or it is left out
    const auto now = progress_now(ticker, at.node(), children[number]);
    if (now && *now <= most) return false;
    is_in_doubt = is_in_doubt || !now;
  }
  const std::uint64_t number = at.detector.number();
  return !is_in_doubt || std::exchange(at.put_off, number) != number;
}

void StallFail::after_tick(Ticker& ticker, Nanoseconds time) {
  for (const Order& order : orders_) {
    if (ticker.take_failed(order.node)) report_(order.standstill, order.node);
  }
  nodes_.after_tick(moments_.after_tick(ticker, 0, time));
}

}  // namespace lockstep::host

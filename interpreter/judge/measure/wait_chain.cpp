#include "judge/measure/wait_chain.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <set>
#include <utility>

#include "base/core/progress.h"
#include "base/core/resource_set.h"
#include "base/core/synchronization.h"

namespace lockstep::host {
namespace {

// Visits the children of a node by the nodes that name them; a barrier and a pool name the members
// around them.
template <class Visit>
void for_each_named(const Shape& shape, NodeIndex node, Visit visit) {
  const bool is_group = shape.nodes[node].is_group();
  for (const NodeIndex child : shape.nodes[node].held()) visit(is_group ? child - 1 : child);
}

// By a member that keeps what it owns: from others it gets it in one of the next ticks.
bool is_denied(const Shape& shape, const Moment& moment, NodeIndex user) {
  return waits(moment.limit(user)) && !lasting_owners(shape, moment, user).empty();
}

std::optional<NodeIndex> first_held(const Shape& shape, const Moment& moment, NodeIndex node) {
  const ShapeNode& it = shape.nodes[node];
  const bool has_held = std::memchr(&moment.activity[node], static_cast<int>(Activity::Paused),
                                    it.end - node) != nullptr;
  if (!it.is_group() && !has_held) return std::nullopt;
  for (const NodeIndex child : it.held()) {
    const NodeIndex named = it.is_group() ? child - 1 : child;
    const bool is_held = !it.is_group() ? moment.held(named)
                         : it.is_pool() ? is_denied(shape, moment, named)
                                        : moment.status(named) == Status::Running &&
                                              moment.is_held_at_barrier(named);
    if (is_held) return named;
  }
  return std::nullopt;
}

// Depth first for a circle; without one it follows the first way to its end.
class WaitSearch {
 public:
  WaitSearch(const Shape& shape, const Moment& moment) : shape_(shape), moment_(moment) {}

  WaitChain from(Withheld begin) {
    if (!find_circle(begin)) {
      const Obstacle obstacle = follow(begin);
      return {std::move(links_), obstacle};
    }
    const auto first = std::ranges::min_element(links_, {}, &WaitLink::node);
    std::rotate(links_.begin(), first, links_.end());
    return {std::move(links_), Obstacle::Circle};
  }

 private:
  // Whoever a node holds waits for the same. Members of a pool wait for different owners.
  NodeIndex key(Withheld at) const { return shape_.nodes[at.node].is_pool() ? at.from : at.node; }

  bool find_circle(Withheld at) {
    const auto again = std::ranges::find_if(links_, [&](const WaitLink& link) {
      return key({link.node, link.waiting}) == key(at);
    });
    if (again != links_.end()) {
      links_.erase(links_.begin(), again);
      set_waiting(links_.front(), at.from);
      return true;
    }
    if (!seen_.insert(key(at)).second) return false;
    const std::size_t place = links_.size();
    add(at);
    for (const NodeIndex awaited : awaited_by(at)) {
      set_awaited(links_[place], awaited);
      const Hindrance hindrance(shape_, moment_, awaited);
      for (const Withheld& next : hindrance.withheld()) {
        if (find_circle(next)) return true;
      }
    }
    links_.pop_back();
    return false;
  }

  Obstacle follow(Withheld at) {
    while (true) {
      WaitLink& link = add(at);
      set_awaited(link, awaited_by(at).front());
      const NodeIndex awaited = link.awaited;
      const Hindrance hindrance(shape_, moment_, awaited);
      if (!hindrance.runs() && !hindrance.withheld().empty()) {
        at = hindrance.withheld().front();
      } else if (const auto inner = next_inner(hindrance, awaited)) {
        at = *inner;
      } else {
        return shape_.nodes[at.node].is_pool() ? Obstacle::Denied : hindrance.obstacle();
      }
    }
  }

  // Something in what is waited for gets ticks, and does not come on: another node may wait for it.
  std::optional<Withheld> next_inner(const Hindrance& hindrance, NodeIndex awaited) {
    for (const NodeIndex node : hindrance.passed()) {
      if (std::ranges::find(links_, node, &WaitLink::node) != links_.end()) continue;
      const auto held = first_held(shape_, moment_, node);
      if (!held) continue;
      const NodeIndex its = awaited_by({node, *held}).front();
      if (awaited <= its && its < shape_.nodes[awaited].end) return Withheld{node, *held};
    }
    return std::nullopt;
  }

  // Whom those that a node holds wait for: the least progressed. Never empty.
  std::vector<NodeIndex> awaited_by(Withheld at) {
    if (shape_.nodes[at.node].is_pool()) return lasting_owners(shape_, moment_, at.from);
    const auto progress = moment_.used(at.node);
    const double most = least_progress(progress) + kProgressEpsilon;
    std::vector<NodeIndex> awaited;
    std::size_t number = 0;
    if (shape_.nodes[at.node].is_group() &&
        waits_to_begin(moment_.status(at.from), moment_.status(at.from + 1))) {
      for_each_named(shape_, at.node, [&](NodeIndex it) {
        const bool is_reached = moment_.status(it) == Status::Running;
        if (progress[number++] == 0 && !is_reached) awaited.push_back(it);
      });
      if (!awaited.empty()) return awaited;
      number = 0;
    }
    for_each_named(shape_, at.node, [&](NodeIndex it) {
      if (progress[number++] <= most) awaited.push_back(it);
    });
    return awaited;
  }

  WaitLink& add(Withheld at) {
    WaitLink& link = links_.emplace_back();
    link.node = at.node;
    set_waiting(link, at.from);
    return link;
  }

  void set_waiting(WaitLink& link, NodeIndex waiting) {
    link.waiting = waiting;
    link.waiting_at = progress_of(waiting, link.node);
  }

  void set_awaited(WaitLink& link, NodeIndex awaited) {
    link.awaited = awaited;
    link.awaited_at = progress_of(awaited, link.node);
    link.awaited_status = moment_.status(awaited);
    if (!shape_.nodes[link.node].is_pool()) return;
    link.resources = resource_set(moment_.limit(link.waiting)) & owned_set(moment_.limit(awaited));
  }

  double progress_of(NodeIndex wanted, NodeIndex node) {
    if (shape_.nodes[node].is_pool()) return moment_.progress_of(wanted);
    const auto progress = moment_.used(node);
    std::size_t number = 0, found = 0;
    for_each_named(shape_, node, [&](NodeIndex it) {
      if (it == wanted) found = number;
      ++number;
    });
    return progress[found];
  }

  const Shape& shape_;
  const Moment& moment_;
  std::vector<WaitLink> links_;
  std::set<NodeIndex> seen_;
};

}  // namespace

bool holds_somebody(const Shape& shape, const Moment& moment, NodeIndex node) {
  return first_held(shape, moment, node).has_value();
}

WaitChain wait_chain(const Shape& shape, const Moment& moment, NodeIndex node) {
  return wait_chain(shape, moment, {node, first_held(shape, moment, node).value_or(node)});
}

WaitChain wait_chain(const Shape& shape, const Moment& moment, Withheld begin) {
  return WaitSearch(shape, moment).from(begin);
}

}  // namespace lockstep::host

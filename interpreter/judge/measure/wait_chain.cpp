#include "judge/measure/wait_chain.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "engine/resources.h"
#include "engine/ticker.h"

namespace lockstep::host {
namespace {

// Visits the children of a node by the nodes that name them; a barrier and a pool name the members
// around them.
template <class Visit>
void for_each_named(const Tree& tree, NodeIndex node, Visit visit) {
  const bool is_group = tree.is_group(node);
  for_each_child(tree, node, [&](NodeIndex child) { visit(is_group ? child - 1 : child); });
}

std::optional<NodeIndex> first_held(Ticker& ticker, NodeIndex node) {
  std::optional<NodeIndex> first;
  const bool is_group = ticker.tree().is_group(node);
  for_each_named(ticker.tree(), node, [&](NodeIndex it) {
    const bool is_held =
        is_group ? ticker.status(it) == Status::Running && is_held_at_barrier(ticker, it)
                 : ticker.held(it);
    if (is_held && !first) first = it;
  });
  return first;
}

// Depth first for a circle; without one it follows the first way to its end.
class WaitSearch {
 public:
  explicit WaitSearch(Ticker& ticker) : ticker_(ticker), tree_(ticker.tree()) {}

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
  NodeIndex key(Withheld at) const { return is_pool(tree_, at.node) ? at.from : at.node; }

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
      const Hindrance hindrance(ticker_, awaited);
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
      const Hindrance hindrance(ticker_, awaited);
      if (!hindrance.runs() && !hindrance.withheld().empty()) {
        at = hindrance.withheld().front();
      } else if (const auto inner = next_inner(hindrance, awaited)) {
        at = *inner;
      } else {
        return is_pool(tree_, at.node) ? Obstacle::Denied : hindrance.obstacle();
      }
    }
  }

  // Something in what is waited for gets ticks, and does not come on: another node may wait for it.
  std::optional<Withheld> next_inner(const Hindrance& hindrance, NodeIndex awaited) {
    for (const NodeIndex node : hindrance.passed()) {
      if (std::ranges::find(links_, node, &WaitLink::node) != links_.end()) continue;
      const auto held = first_held(ticker_, node);
      if (!held) continue;
      const NodeIndex its = awaited_by({node, *held}).front();
      if (awaited <= its && its < ticker_.end_of(awaited)) return Withheld{node, *held};
    }
    return std::nullopt;
  }

  // Whom those that a node holds wait for: the least progressed. Never empty.
  std::vector<NodeIndex> awaited_by(Withheld at) {
    if (is_pool(tree_, at.node)) return lasting_owners(ticker_, tree_.membership(at.from));
    const auto progress = child_progress(ticker_, at.node);
    const double most = least_progress(progress) + kProgressEpsilon;
    std::vector<NodeIndex> awaited;
    std::size_t number = 0;
    if (tree_.is_group(at.node) &&
        waits_to_begin(ticker_.status(at.from), ticker_.status(at.from + 1))) {
      for_each_named(tree_, at.node, [&](NodeIndex it) {
        const bool is_reached = ticker_.status(it) == Status::Running;
        if (progress[number++] == 0 && !is_reached) awaited.push_back(it);
      });
      if (!awaited.empty()) return awaited;
      number = 0;
    }
    for_each_named(tree_, at.node, [&](NodeIndex it) {
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
    link.awaited_status = ticker_.status(awaited);
    if (!is_pool(tree_, link.node)) return;
    link.resources =
        resource_set(limit(ticker_, link.waiting)) & resource_set(limit(ticker_, awaited));
  }

  double progress_of(NodeIndex wanted, NodeIndex node) {
    if (is_pool(tree_, node)) return ticker_.progress(wanted);
    const auto progress = child_progress(ticker_, node);
    std::size_t number = 0, found = 0;
    for_each_named(tree_, node, [&](NodeIndex it) {
      if (it == wanted) found = number;
      ++number;
    });
    return progress[found];
  }

  Ticker& ticker_;
  const Tree& tree_;
  std::vector<WaitLink> links_;
  std::set<NodeIndex> seen_;
};

}  // namespace

bool holds_somebody(Ticker& ticker, NodeIndex node) {
  return first_held(ticker, node).has_value();
}

WaitChain wait_chain(Ticker& ticker, NodeIndex node) {
  return WaitSearch(ticker).from({node, first_held(ticker, node).value_or(node)});
}

}  // namespace lockstep::host

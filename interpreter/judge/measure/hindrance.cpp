#include "judge/measure/hindrance.h"

#include <algorithm>
#include <cmath>

#include "engine/resources.h"
#include "engine/ticker.h"

namespace lockstep::host {
namespace {

// Null: it is no member of any group.
const Member* membership_of(const Tree& tree, NodeIndex node) {
  const auto it = std::ranges::find(tree.members, node, &Member::node);
  return it == tree.members.end() ? nullptr : &*it;
}

// In this tick.
bool owns(Ticker& ticker, NodeIndex user) {
  const auto& use = ticker.state<ResourceUse>(user);
  return resources::has_asked(ticker, use) && use.grant == Grant::Owned;
}

}  // namespace

Hindrance::Hindrance(Ticker& ticker, NodeIndex node) : ticker_(ticker), tree_(ticker.tree()) {
  const Status status = ticker.status(node);
  if (status == Status::Running) {
    look_at(node);
  } else if (status == Status::Failure) {
    obstacle_ = Obstacle::Failed;
  } else {
    obstacle_ = Obstacle::Idle;
    look_before(node);
  }
}

// Looks at a node that runs.
void Hindrance::look_at(NodeIndex node) {
  ticker_.held(node) ? look_around(node) : look_inside(node);
}

// A node that is held, perhaps as a part of what is.
void Hindrance::look_around(NodeIndex node) {
  while (node != 0 && ticker_.held(tree_.labels[node].parent)) node = tree_.labels[node].parent;
  const NodeIndex parent = tree_.labels[node].parent;
  if (compares_progress(synchronization(tree_.nodes[parent]))) {
    withheld_.push_back({parent, node});
  } else if (const Member* const member = membership_of(tree_, parent)) {
    add(*member);
  } else {
    runs_ = true;
  }
}

// A node that gets ticks. Of several children that run, those count that are as far as it is: a
// parallel is as far as what it lacks.
void Hindrance::look_inside(NodeIndex node) {
  if (lacks_resources(node)) return add_user(tree_.membership(node));
  pass(node);
  const std::vector<NodeIndex> running = running_children(node);
  if (running.empty()) runs_ = true;
  std::vector<NodeIndex> decisive;
  if (running.size() > 1) {
    const double reached = ticker_.progress(node);
    std::ranges::copy_if(running, std::back_inserter(decisive), [&](NodeIndex child) {
      return std::fabs(ticker_.progress(child) - reached) <= kProgressEpsilon;
    });
  }
  for (const NodeIndex child : decisive.empty() ? running : decisive) look_at(child);
}

void Hindrance::pass(NodeIndex node) {
  if (compares_progress(synchronization(tree_.nodes[node]))) passed_.push_back(node);
  const Member* const member = membership_of(tree_, node);
  if (member != nullptr && !is_pool(tree_, member->group)) passed_.push_back(member->group);
}

// A node that does not run: what it is inside of, or what runs where it may be its turn next.
void Hindrance::look_before(NodeIndex node) {
  NodeIndex below = node;
  for (; ticker_.status(node) != Status::Running; node = tree_.labels[node].parent) {
    if (node == 0) return;
    below = node;
  }
  if (ticker_.held(node)) return look_around(node);
  if (lacks_resources(node)) return add_user(tree_.membership(node));
  if (ticker_.status(below) != Status::Idle) return;  // it has completed without this one
  for (const NodeIndex child : running_children(node)) look_at(child);
  runs_ = false;
}

bool Hindrance::lacks_resources(NodeIndex node) const {
  const Member* const member = membership_of(tree_, node);
  return member != nullptr && is_pool(tree_, member->group) && !owns(ticker_, node);
}

void Hindrance::add(const Member& member) {
  if (is_pool(tree_, member.group)) return add_user(member);
  withheld_.push_back({member.group, member.node});
}

void Hindrance::add_user(const Member& member) {
  if (ticker_.state<ResourceUse>(member.node).grant == Grant::Closed) return add_gates(member);
  if (lasting_owners(ticker_, member).empty()) {
    runs_ = true;
  } else {
    withheld_.push_back({member.group, member.node});
  }
}

void Hindrance::add_gates(const Member& user) {
  for (const NodeIndex gate : tree_.gates_of(user)) {
    const Member& member = tree_.membership(gate);
    const bool is_open =
        is_pool(tree_, member.group) ? owns(ticker_, gate) : !is_held_at_barrier(ticker_, gate);
    if (!is_open) add(member);
  }
}

std::vector<NodeIndex> Hindrance::running_children(NodeIndex node) const {
  std::vector<NodeIndex> running;
  for (NodeIndex child = node + 1; child != ticker_.end_of(node); child = ticker_.end_of(child)) {
    if (ticker_.status(child) == Status::Running) running.push_back(child);
  }
  return running;
}

std::vector<NodeIndex> lasting_owners(Ticker& ticker, const Member& denied) {
  std::vector<NodeIndex> owners;
  const bool first_wins = ticker.parameter(denied.group, resources::kIncrement).integer == 0;
  const ResourceSet wanted = resource_set(limit(ticker, denied.node));
  for (const Member& owner : ticker.tree().members_of(denied.group)) {
    const double its = limit(ticker, owner.node);
    if (waits(its) || (resource_set(its) & wanted) == 0) continue;
    const bool keeps = ticker.parameter(owner.node, resources::kKeep).boolean &&
                       ticker.status(owner.node + 1) == Status::Running;
    if (keeps || (first_wins && owner.number < denied.number)) owners.push_back(owner.node);
  }
  return owners;
}

}  // namespace lockstep::host

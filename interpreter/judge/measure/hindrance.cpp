#include "judge/measure/hindrance.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/core/progress.h"
#include "base/core/resource_set.h"
#include "base/core/synchronization.h"

namespace lockstep::host {

Hindrance::Hindrance(const Shape& shape, const Moment& moment, NodeIndex node)
    : shape_(shape), moment_(moment) {
  const Status status = moment.status(node);
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
  moment_.held(node) ? look_around(node) : look_inside(node);
}

// A node that is held, perhaps as a part of what is.
void Hindrance::look_around(NodeIndex node) {
  const auto parent_of = [&](NodeIndex it) { return shape_.nodes[it].parent.value_or(it); };
  while (node != 0 && moment_.held(parent_of(node))) node = parent_of(node);
  const NodeIndex parent = parent_of(node);
  if (compares_progress(shape_.nodes[parent].synchronization)) {
    withheld_.push_back({parent, node});
  } else if (shape_.nodes[parent].group) {
    add(parent);
  } else {
    runs_ = true;
  }
}

// A node that gets ticks. Of several children that run, those count that are as far as it is: a
// parallel is as far as what it lacks.
void Hindrance::look_inside(NodeIndex node) {
  if (lacks_resources(node)) return add_user(node);
  if (waits_to_begin(node)) return add(node);
  pass(node);
  const std::vector<NodeIndex> running = running_children(node);
  if (running.empty()) runs_ = true;
  std::vector<NodeIndex> decisive;
  if (running.size() > 1) {
    const double reached = moment_.progress_of(node);
    std::ranges::copy_if(running, std::back_inserter(decisive), [&](NodeIndex child) {
      return std::fabs(moment_.progress_of(child) - reached) <= kProgressEpsilon;
    });
  }
  for (const NodeIndex child : decisive.empty() ? running : decisive) look_at(child);
}

void Hindrance::pass(NodeIndex node) {
  if (compares_progress(shape_.nodes[node].synchronization)) passed_.push_back(node);
  const auto group = shape_.nodes[node].group;
  if (group && !shape_.nodes[*group].is_pool()) passed_.push_back(*group);
}

// A node that does not run: what it is inside of, or what runs where it may be its turn next.
void Hindrance::look_before(NodeIndex node) {
  NodeIndex below = node;
  for (; moment_.status(node) != Status::Running; node = *shape_.nodes[node].parent) {
    if (!shape_.nodes[node].parent) return;
    below = node;
  }
  if (moment_.held(node)) return look_around(node);
  if (lacks_resources(node)) return add_user(node);
  if (moment_.status(below) != Status::Idle) return;  // it has completed without this one
  for (const NodeIndex child : running_children(node)) look_at(child);
  runs_ = false;
}

// A barrier at 0 holds it before its child begins.
bool Hindrance::waits_to_begin(NodeIndex node) const {
  const auto group = shape_.nodes[node].group;
  return group && !shape_.nodes[*group].is_pool() &&
         host::waits_to_begin(moment_.status(node), moment_.status(node + 1));
}

bool Hindrance::lacks_resources(NodeIndex node) const {
  const auto group = shape_.nodes[node].group;
  return group && shape_.nodes[*group].is_pool() && !owns(moment_.limit(node));
}

void Hindrance::add(NodeIndex member) {
  const NodeIndex group = *shape_.nodes[member].group;
  if (shape_.nodes[group].is_pool()) return add_user(member);
  withheld_.push_back({group, member});
}

// One that does not wait has not asked: a barrier or an outer pool withholds its ticks.
void Hindrance::add_user(NodeIndex user) {
  if (!waits(moment_.limit(user))) return add_gates(user);
  if (lasting_owners(shape_, moment_, user).empty()) {
    runs_ = true;
  } else {
    withheld_.push_back({*shape_.nodes[user].group, user});
  }
}

void Hindrance::add_gates(NodeIndex user) {
  bool is_open = true;
  for (const NodeIndex gate : shape_.nodes[user].gates) {
    const bool is_of_pool = shape_.nodes[*shape_.nodes[gate].group].is_pool();
    if (is_of_pool ? owns(moment_.limit(gate)) : !moment_.is_held_at_barrier(gate)) continue;
    is_open = false;
    add(gate);
  }
  runs_ |= is_open;
}

std::vector<NodeIndex> Hindrance::running_children(NodeIndex node) const {
  std::vector<NodeIndex> running;
  std::ranges::copy_if(shape_.nodes[node].children, std::back_inserter(running),
                       [&](NodeIndex child) { return moment_.status(child) == Status::Running; });
  return running;
}

std::vector<NodeIndex> lasting_owners(const Shape& shape, const Moment& moment, NodeIndex denied) {
  std::vector<NodeIndex> owners;
  const ShapeNode& pool = shape.nodes[*shape.nodes[denied].group];
  const double its_limit = moment.limit(denied);
  const ResourceSet wanted = resource_set(its_limit) & ~owned_set(its_limit);
  for (const NodeIndex child : pool.members) {
    const NodeIndex owner = *shape.nodes[child].parent;
    if (owner == denied || (owned_set(moment.limit(owner)) & wanted) == 0) continue;
    const ShapeNode& user = shape.nodes[owner];
    const bool keeps = user.keeps_resources &&
                       (moment.status(child) == Status::Running || waits(moment.limit(owner)));
    const bool is_before = user.number < shape.nodes[denied].number;
    if (keeps || (pool.first_wins && is_before)) owners.push_back(owner);
  }
  return owners;
}

}  // namespace lockstep::host

// Decides which node owns which resources of a pool, for its nodes, views and recordings. A pool is
// a group (Tree::groups); its members are the nodes that use its resources.
#pragma once

#include <cstdint>

#include "base/core/resource_set.h"
#include "engine/synchronized.h"

namespace lockstep::host {

// The answer to a member that asked for its resources.
enum class Grant : std::uint8_t {
  Owned,   // its child may be ticked
  Denied,  // another member owns one of them
  Closed,  // a barrier or an outer pool withholds ticks from it, so it did not ask
};

// The state of a member. Its limit (engine/synchronized.h) is the set that it owns in this tick;
// negative: the set that it waits for; 0: neither.
struct ResourceUse : SynchronizedState {
  ResourceSet owned;      // while it is Owned
  std::int64_t priority;  // rises with each tick in which it is Denied
  std::uint32_t asked;    // in this tick, for its number
  Grant grant;
};

// The state of a pool.
struct ResourcePool : SynchronizedState {
  ResourceSet owned;  // in this tick, by all members
};

inline bool is_pool(const Tree& tree, NodeIndex node) {
  return synchronization(tree.nodes[node]) == Synchronization::Resources;
}

// Visits the members of all pools.
template <class Visit>
void for_each_resource_user(const Tree& tree, Visit visit) {
  for (const Member& member : tree.members) {
    if (is_pool(tree, member.group)) visit(member.node);
  }
}

namespace resources {

// Where the parameters of a pool and of a member stand in their cells.
inline constexpr unsigned kIncrement = 0;
inline constexpr unsigned kResources = 1, kKeep = 2;

// Of the tree: whether a member keeps its set as long as its child runs, and whether those of a
// pool that wait do not get more urgent.
bool may_keep(const Tree& tree, NodeIndex member);
bool first_wins(const Tree& tree, NodeIndex pool);

// Finds the mistake in a list of resources, if one is given.
std::optional<RuleBreak> check_list(const ParameterValues& given, unsigned parameter);

// True when the member has an answer for this tick.
inline bool has_asked(const NodeContext& context, const ResourceUse& use) {
  return use.asked == context.tick_number();
}

// Between two ticks: whether a member owned any of these in the last one.
inline bool owned_in_last_tick(const NodeContext& context, const ResourceUse& use,
                               ResourceSet any) {
  return has_asked(context, use) && use.grant == Grant::Owned && (use.owned & any) != 0;
}

// Decides for this tick whether a member gets its resources: those that no other member owns.
void ask(NodeContext& context, NodeIndex member);
// A child that runs keeps its set until it completes or is halted, if its member says so. A
// SyncProgress that waits to begin runs without a set.
bool keeps(NodeContext& context, NodeIndex member);
// Decides so.
void keep(NodeContext& context, NodeIndex member);
// The child of a member was skipped without having run: others may have its resources in this tick.
void give_back(NodeContext& context, NodeIndex member);

}  // namespace resources

}  // namespace lockstep::host

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

// The state of a member. Its limit (engine/synchronized.h) is the set that it owns in this tick, or
// waits for: base/core/resource_set.h.
struct ResourceUse : SynchronizedState {
  ResourceSet owned;      // since its last grant in this activation; 0: none yet
  ResourceSet handed;     // by members before it, until its child runs
  ResourceSet granted;    // in this tick; those that it exchanges, it owns when a tick reaches it
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
inline constexpr unsigned kIncrement = 0, kTeam = 2, kAs = 3;
inline constexpr unsigned kResources = 1, kKeep = 2, kOnChange = 3, kGranted = 4;

// What a member does while its child runs: the words of on_change="…".
enum class OnChange : std::uint8_t {
  Release,   // it asks for its resources in each tick
  Keep,      // it keeps those that it has
  Exchange,  // it keeps them until it gets those that its entry names now
};
inline constexpr std::string_view kOnChangeChoices[] = {"release", "keep", "exchange"};

// Of the tree: that of a member, and whether those of a pool that wait do not get more urgent.
OnChange on_change(const Tree& tree, NodeIndex member);
bool first_wins(const Tree& tree, NodeIndex pool);

// Finds the mistake in a list of resources, if one is given. `may_choose`: it may have any(…).
std::optional<RuleBreak> check_list(const ParameterValues& given, unsigned parameter,
                                    bool may_choose);

// What asks the team for the resources of a member, where robots share the pool: a leaf behind its
// child. Nothing: the pool is of this tree alone.
std::optional<NodeIndex> asker_of(const Tree& tree, NodeIndex member);

// True when the member has an answer for this tick.
inline bool has_asked(const NodeContext& context, const ResourceUse& use) {
  return use.asked == context.tick_number();
}

// Between two ticks: whether a member owned any of these in the last one.
inline bool owned_in_last_tick(const ResourceUse& use, ResourceSet any) {
  return (owned_set(use.limit) & any) != 0;
}

// Decides for this tick whether a member gets its resources: those that no other member owns. What
// members around it and inside of it own is no obstacle. In its first tick it takes over what those
// before it in a Sequence have owned in this tick, if it keeps resources.
void ask(NodeContext& context, NodeIndex member);
// Its child runs and has resources that no other member gets, whatever the member waits for; or
// they are reserved for it while its team is asked. A SyncProgress that waits to begin runs without
// any.
bool keeps(NodeContext& context, NodeIndex member);
// The same, or it has taken over resources and has not begun: which.
ResourceSet kept_set(NodeContext& context, NodeIndex member);
// Before the root is ticked: the member keeps what it has. True: it asks for nothing else.
bool keep(NodeContext& context, NodeIndex member);
// After a tick: what a member waits for with its team is not reserved any more if no tick has
// reached it, so that others of this tree get it. Then its limit is as if it owned that.
void forget_unasked(NodeContext& context, NodeIndex member);
// The child of a member was skipped without having run: others may have its resources in this tick.
void give_back(NodeContext& context, NodeIndex member);

}  // namespace resources

}  // namespace lockstep::host

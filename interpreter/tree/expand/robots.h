// The nodes that stand for the other robots of a team: behind the child of the node that is in step
// with them, each of them; behind the child of one that uses resources that they share, all.
#pragma once

#include <span>
#include <string_view>

#include "language/document/reporter.h"
#include "tree/checked_tree.h"

namespace lockstep::host {

// The types of such nodes: of the plugin that a project with a team gets (team/team_run.h).
inline constexpr std::string_view kTeamMember = "TeamMember", kTeamResources = "TeamResources";

// `place`: the node, whose child is there already. `team`: the group that it names.
void add_robots(Definition& definition, const CheckedTrees& trees, const CheckedNode& team,
                std::uint32_t place, const Reporter& report);

// `place`: a member of `pool`, whose child is there already. `number`: of it among them. `team`:
// the group of robots that shares the pool. From now on it keeps its resources while its child
// runs.
void add_asker(Definition& definition, const CheckedTrees& trees, const CheckedNode& pool,
               const CheckedNode& team, std::uint32_t place, std::uint32_t number,
               const Reporter& report);

// The name of the team that shares a pool; "": none does.
std::string_view team_of(const CheckedTrees& trees, std::span<const Value> values,
                         const CheckedNode& pool);

}  // namespace lockstep::host

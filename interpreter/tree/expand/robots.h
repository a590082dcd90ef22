// The nodes that stand for the other robots of a team, behind the child of the node that is in step
// with them.
#pragma once

#include "language/document/reporter.h"
#include "tree/checked_tree.h"

namespace lockstep::host {

// The type of such a node: of the plugin that a project with a team gets (team/team_plugin.h).
inline constexpr std::string_view kTeamMember = "TeamMember";

// `place`: the node, whose child is there already. `team`: the group that it names.
void add_robots(Definition& definition, const CheckedTrees& trees, const CheckedNode& team,
                std::uint32_t place, const Reporter& report);

}  // namespace lockstep::host

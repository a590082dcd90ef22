// Which nodes of a definition pace what they hold: engine/pace.h.
#pragma once

#include "tree/definition.h"

namespace lockstep::host {

bool paces(const Definition& definition, const DefinitionNode& node);
bool paces(const Definition& definition);

// Sets DefinitionNode::is_slowed, once all nodes and groups are there.
void mark_slowed(Definition& definition);

// As if no node had pace="true". For a search of all behaviors: a leaf may be as slow as it likes
// there, so whatever holds without pace holds with it.
void ignore_pace(Definition& definition);

}  // namespace lockstep::host

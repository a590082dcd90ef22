// The pools of a definition: the names of their resources, and rules about who may use them.
#pragma once

#include "language/document/reporter.h"
#include "tree/definition.h"

namespace lockstep::host {

// Numbers the names of each pool (DefinitionGroup::resources). Reports names that a pool does not
// have, pools without a name or with too many, and members that would wait for each other for ever.
void resolve_resources(Definition& definition, const Reporter& report);

// Warns of members that may wait for ever, and of names that look misspelled.
void advise_resources(const Definition& definition, const Reporter& report);

}  // namespace lockstep::host

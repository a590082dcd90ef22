// The rules about groups, which only the expanded tree shows: whether the members of a barrier can
// meet.
#pragma once

#include "language/document/reporter.h"
#include "tree/definition.h"

namespace lockstep::host {

// Reports barriers whose members never meet: only one member, a member inside another, two in
// different children of a node that runs one child after the other, and barriers that wait for each
// other in a circle.
void check_groups(const Definition& definition, const Reporter& report);

}  // namespace lockstep::host

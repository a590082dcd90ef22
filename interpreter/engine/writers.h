// Which nodes may write an entry: what a person who finds a value wants to know. A static fact, so
// that writing costs nothing more.
#pragma once

#include <vector>

#include "engine/tree.h"

namespace lockstep::host {

// By slot, each in pre-order: nodes with a port or a script that writes it. Not those that look
// entries up by name while they run.
std::vector<std::vector<NodeIndex>> writers(const Tree& tree);

}  // namespace lockstep::host

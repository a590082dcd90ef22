// What a search cannot know about a tree: it is told with its place, and never guessed.
#pragma once

#include <vector>

#include "leaves/models.h"

namespace lockstep::host {

std::vector<NodeProblem> not_verifiable(const Tree& tree);

}  // namespace lockstep::host

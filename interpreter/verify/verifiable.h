// Finds what a search cannot know about a tree. Each has a place, and nothing is guessed.
#pragma once

#include <vector>

#include "leaves/models.h"

namespace lockstep::host {

std::vector<NodeProblem> not_verifiable(const Tree& tree);

}  // namespace lockstep::host

// Finds what a search cannot know about a tree. Each has a place, and nothing is guessed.
#pragma once

#include <span>
#include <vector>

#include "language/property/property.h"
#include "leaves/models.h"

namespace lockstep::host {

std::vector<NodeProblem> not_verifiable(const Tree& tree);

// The entries and progress that properties compare. Those that a search cannot know go to
// `problems`.
Observed observed_by(const Tree& tree, std::span<const Property> properties,
                     std::vector<NodeProblem>& problems);

}  // namespace lockstep::host

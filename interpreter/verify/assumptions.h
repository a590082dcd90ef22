// What a search takes for granted of the leaves and of time.
#pragma once

#include <string>
#include <vector>

#include "leaves/models.h"

namespace lockstep::host {

// `paces`: nodes of the tree pace, and the search is of the tree without that.
std::vector<std::string> assumptions(const Tree& tree, const LeafModels& models, double rate,
                                     bool paces);

}  // namespace lockstep::host

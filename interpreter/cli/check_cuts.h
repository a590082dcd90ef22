// `check --checkpoint`: what each leaf of a tree does after a cut, before the robot moves.
#pragma once

#include <string>

#include "tree/definition.h"

namespace lockstep::host {

// Rows of the leaves that can run at a cut; docs/resume.md. Ends with a line break.
std::string cuts_text(const Definition& definition);

}  // namespace lockstep::host

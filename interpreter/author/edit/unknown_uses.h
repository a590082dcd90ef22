// Nodes of which nobody can say here what entries they use.
#pragma once

#include <optional>

#include "author/edit/project_texts.h"

namespace lockstep::host {

// Why the entries of a part are not all known: a leaf opens some that no port names, or a node is
// in no plugin and no model.
std::optional<Problem> unknown_uses(const ProjectTexts& texts, ElementAt part);

}  // namespace lockstep::host

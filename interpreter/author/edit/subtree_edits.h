// A part of a tree becomes a tree, and a SubTree becomes the nodes of its tree. The tree runs as
// before; paths of the nodes in it change.
#pragma once

#include <string_view>

#include "author/edit/project_texts.h"

namespace lockstep::host {

// The node becomes the BehaviorTree `id`, which no tree has so far, behind the one that it is in.
// In its place is a SubTree that binds each entry that the node uses.
Result<ProjectEdit> extract_subtree(const ProjectTexts& texts, ElementAt node, std::string_view id);

// The SubTree becomes the nodes of its tree, which stays. Entries that only it has get names that
// are free here. Fails where nodes cannot say the same, as for a start value of an entry, and where
// the tree is in a file that is included with another name than this one.
Result<ProjectEdit> inline_subtree(const ProjectTexts& texts, ElementAt sub_tree);

}  // namespace lockstep::host

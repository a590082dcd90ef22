// Other names for trees, entries and arguments, in all files of a project.
#pragma once

#include <string_view>

#include "author/edit/project_texts.h"

namespace lockstep::host {

// A BehaviorTree, each SubTree of it, and where it is named as the main tree.
Result<ProjectEdit> rename_tree(const ProjectTexts& texts, std::string_view id,
                                std::string_view new_id);

// An entry of a tree: in its ports and scripts, and where SubTrees of it bind it. What was passed
// on without an attribute gets one. Of the main tree, also in properties and scenarios of its file.
Result<ProjectEdit> rename_entry(const ProjectTexts& texts, std::string_view tree,
                                 std::string_view key, std::string_view new_key);

// An <arg>, and each ${name}.
Result<ProjectEdit> rename_argument(const ProjectTexts& texts, std::string_view name,
                                    std::string_view new_name);

}  // namespace lockstep::host

// A project file, lockstep.project.xml, which is beside the tree files of a project or above them:
//   <project lockstep="1">
//     <main file="trees/main.xml"/>   what a command runs that is given no tree file
//     <trees folder="trees"/>         SubTrees find their trees there
//     <plugins folder="build"/>       as --plugin-path
//     <models file="models.xml"/>     an include of each tree file
//   </project>
#pragma once

#include <string>
#include <string_view>

#include "run/loading/load.h"

namespace lockstep::host {

inline constexpr std::string_view kProjectFile = "lockstep.project.xml";

// The options for a tree file with what its project file adds to them. Plugin folders count only
// in a file that belongs to the user, or to root, and that others cannot write. A program with more
// rights than its user reads no such file.
LoadOptions with_project_file(const std::string& tree, LoadOptions options,
                              Diagnostics& diagnostics);

// The main file of the project in the current folder or above it; "" if there is none.
std::string main_file_here(Diagnostics& diagnostics);

}  // namespace lockstep::host

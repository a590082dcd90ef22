// Whether everyone on this machine could change what is about to be loaded. It warns; what is right
// on a robot with one user is its owner's matter (docs/security.md).
#pragma once

#include <span>
#include <string>

#include "core/diagnostics.h"

namespace lockstep {

// Of the file and the directory it lies in; of a symbolic link, of all that it leads to as well.
void warn_of_writable_plugin(const std::string& path, const SourceLocation& where,
                             Diagnostics& diagnostics);
// Of directories that are searched: who may add a file to one that comes first decides what is
// found.
void warn_of_writable_directories(std::span<const std::string> directories,
                                  const SourceLocation& where, Diagnostics& diagnostics);

}  // namespace lockstep

// Warns if every user of this machine could change what is about to be loaded. It only warns,
// because this may be intended on a robot with one user (docs/security.md).
#pragma once

#include <span>
#include <string>

#include "base/core/diagnostics.h"

namespace lockstep::host {

// Warns of the file and the directory it lies in; for a symbolic link, of all that it leads to as
// well.
void warn_of_writable_plugin(const std::string& path, const SourceLocation& where,
                             Diagnostics& diagnostics);
// For directories that are searched: anyone who may add a file to an earlier one decides what is
// found.
void warn_of_writable_directories(std::span<const std::string> directories,
                                  const SourceLocation& where, Diagnostics& diagnostics);

}  // namespace lockstep::host

// Writes a file of a study's directory so that a kill leaves the old one or the new one, never a
// half.
#pragma once

#include <string>
#include <string_view>

#include "core/problem.h"

namespace lockstep::host {

// Never through a symbolic link.
Result<void> write_whole_file(const std::string& path, std::string_view text);

}  // namespace lockstep::host

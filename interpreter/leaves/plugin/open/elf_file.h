// Checks the header of a file before the dynamic linker does. Only for shared_object.cpp.
#pragma once

#include <optional>
#include <string>

#include "base/core/problem.h"

namespace lockstep::host {

// Returns nothing if the file is a complete shared object for this machine.
std::optional<Problem> inspect_elf_file(const std::string& path);

}  // namespace lockstep::host

// Looks at the header of a file before the dynamic linker does. Only for shared_object.cpp.
#pragma once

#include <optional>
#include <string>

#include "plugin/refusal.h"

namespace lockstep {

// Nothing when the file is a complete shared object for this machine.
std::optional<Refusal> inspect_elf_file(const std::string& path);

}  // namespace lockstep

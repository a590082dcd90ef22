// Finds the file of a plugin that a tree names. Searches directories, opens nothing.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/problem.h"

namespace lockstep {

// The path of <name>.so in the first of `directories` that has it, or why there is none.
[[nodiscard]] Result<std::string> find_plugin_file(std::string_view name,
                                                   std::span<const std::string> directories);

}  // namespace lockstep

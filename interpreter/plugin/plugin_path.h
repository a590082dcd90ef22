// Where a plugin that a tree names lies. Looks at directories, opens nothing.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "plugin/refusal.h"

namespace lockstep {

// The path of <name>.so in the first of `directories` that has it, or why there is none.
std::optional<Refusal> find_plugin_file(std::string_view name,
                                        std::span<const std::string> directories,
                                        std::string& path);

}  // namespace lockstep

// Finds the file of a plugin that a tree names. Searches directories, opens nothing.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/core/problem.h"

namespace lockstep::host {

// The path of <name>.so in the first of `directories` that has it, or why there is none.
[[nodiscard]] Result<std::string> find_plugin_file(std::string_view name,
                                                   std::span<const std::string> directories);

// The same of a program, by the name of its file, which must be executable.
[[nodiscard]] Result<std::string> find_program_file(std::string_view file,
                                                    std::span<const std::string> directories);
// The file of a program that is called like the plugin, "grip.py" for "grip", or for "grip.py"
// itself, in the first of `directories` that has one; "" when none has.
[[nodiscard]] std::string program_named(std::string_view name,
                                        std::span<const std::string> directories);
// A hint to give the directory of `what`, such as a plugin or the plugin of a leaf.
[[nodiscard]] std::string add_directory(std::string_view what);
bool is_executable(const std::string& path);  // a regular file that this user may execute

}  // namespace lockstep::host

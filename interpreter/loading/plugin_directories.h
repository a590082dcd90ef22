// Where plugins are searched, and which of that is refused to a program that runs with more rights
// than its user: setuid, setgid, or with file capabilities (docs/security.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "loading/plugins.h"

namespace lockstep {

// Of this program; "" when the system does not tell.
std::filesystem::path program_directory();

// --plugin-path, then LOCKSTEP_PLUGIN_PATH, then where plugins are installed beside this program.
// Relative ones are left out when the program is privileged.
std::vector<std::string> plugin_directories(const PluginOptions& options);

// Warns of directories that are not there. False, with errors, when the program is privileged and a
// directory or file that is given for plugins is relative: who chooses the working directory would
// choose what is loaded. Warns of LOCKSTEP_PLUGIN_PATH, which is not read then.
bool check_plugin_options(const PluginOptions& options, Diagnostics& diagnostics);

}  // namespace lockstep

// Where plugins are searched, and which paths are refused if the program has more rights than its
// user: setuid, setgid, or file capabilities (docs/security.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "run/loading/plugins.h"

namespace lockstep::host {

// The directory that the options name, else that of this program; "" when the system does not tell.
std::filesystem::path program_directory(const PluginOptions& options);

// --plugin-path, then LOCKSTEP_PLUGIN_PATH, then lib/lockstep/plugins of each prefix in
// AMENT_PREFIX_PATH that has it, then where plugins are installed beside this program, then that of
// the user's project.
// Relative ones are left out when the program is privileged.
std::vector<std::string> plugin_directories(const PluginOptions& options);

// Whether this program has more rights than its user.
bool is_privileged();

// Warns about missing directories. Returns false, with errors, if the program is privileged and a
// plugin directory or file is relative: otherwise the user who chooses the working directory would
// choose the code. Then it also warns that LOCKSTEP_PLUGIN_PATH is not read.
bool check_plugin_options(const PluginOptions& options, Diagnostics& diagnostics);

}  // namespace lockstep::host

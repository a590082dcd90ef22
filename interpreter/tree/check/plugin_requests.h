// The plugins that a project requests with <plugin name="…" …/>. Finding and loading them
// is done elsewhere.
#pragma once

#include <string>
#include <vector>

#include "base/core/diagnostics.h"
#include "language/document/project.h"

namespace lockstep::host {

inline constexpr std::size_t kMaxPlugins = 256;  // each may be a process

struct PluginRequest {
  std::string name;
  Place place;               // of the attribute that names it
  bool isolate = false;      // in a separate process
  std::string program = {};  // the file of a program; "": it is a shared object
  std::string hold = {};     // "signal", "message", "none"; "": as the program says
};

// Each name once, in the order of the documents; isolated if one of its elements requests it.
std::vector<PluginRequest> requested_plugins(const Project& project, Diagnostics& diagnostics);

}  // namespace lockstep::host

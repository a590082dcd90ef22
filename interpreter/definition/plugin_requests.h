// The plugins that a project asks for by <plugin name="…" isolate="…"/>. Who loads them, and where
// they are found, is decided elsewhere.
#pragma once

#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "document/project.h"

namespace lockstep {

inline constexpr std::size_t kMaxPlugins = 256;  // each may be a process

struct PluginRequest {
  std::string name;
  Place place;           // of the attribute that names it
  bool isolate = false;  // in a process of its own
};

// Each name once, in the order of the documents; isolated when one of its elements says so.
std::vector<PluginRequest> requested_plugins(const Project& project, Diagnostics& diagnostics);

}  // namespace lockstep

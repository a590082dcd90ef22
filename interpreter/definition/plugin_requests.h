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
  const Document* document = nullptr;  // where the name stands: an attribute of `element`
  std::uint32_t element = 0;
  bool isolate = false;  // in a process of its own

  SourceLocation where() const { return document->locate_value(element, "name"); }
};

// Each name once, in the order of the documents; isolated when one of its elements says so.
std::vector<PluginRequest> requested_plugins(const Project& project, Diagnostics& diagnostics);

}  // namespace lockstep

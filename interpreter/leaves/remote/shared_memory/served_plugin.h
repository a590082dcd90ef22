// The server of an isolated plugin, in the process that loaded it: answers the calls of the host
// one after the other. To the plugin it is the host.
#pragma once

#include <string>

namespace lockstep::host {

// Serves the plugin in `path` over the LeafhostDescriptors until the host ends it; the
// process's exit code. Nothing when this process was not started by a host.
struct ServedPlugin {
  static bool has_host();
  static int serve(const std::string& path);
};

}  // namespace lockstep::host

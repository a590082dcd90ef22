// What `run --monitor` and `replay --monitor` have in common: where they listen, and the link that
// they show.
#pragma once

#include <string>

#include "core/problem.h"
#include "web/registry.h"
#include "web/server_socket.h"

namespace lockstep {

// The value of --monitor; refused if this lockstep has no monitor.
Result<ServerSocket> listen_for_monitor(const std::string& address);

// Prints the link, lists it for `lockstep monitor` while it exists, and opens it if `opens`.
class MonitorLink {
 public:
  MonitorLink(const std::string& link, const std::string& file, bool opens);

 private:
  const Registration registration_;
};

}  // namespace lockstep

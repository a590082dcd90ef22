// The options that `run --monitor` and `replay --monitor` share: where they listen, and the link
// that they show.
#pragma once

#include <string>

#include "base/core/problem.h"
#include "show/web/attach_socket.h"
#include "show/web/registry.h"
#include "show/web/server_socket.h"

namespace lockstep::host {

// The values of --monitor and --monitor-socket; refused if this lockstep has no monitor.
Result<ServerSocket> listen_for_monitor(const std::string& address);
Result<AttachSocket> make_monitor_socket(const std::string& path);

// Lists the run, or the recording, for `lockstep monitor` while it exists.
class MonitorLink {
 public:
  // `socket`: as that of a Registration.
  explicit MonitorLink(const std::string& file, const std::string& socket = "")
      : registration_(file, socket) {}

  // Prints the link, lists it, and opens it if `opens`.
  void tell(const std::string& link, bool opens);

 private:
  Registration registration_;
};

}  // namespace lockstep::host

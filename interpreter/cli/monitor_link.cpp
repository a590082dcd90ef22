#include "cli/monitor_link.h"

#include "runtime/outlet.h"
#include "web/browser.h"
#include "web/http_server.h"

namespace lockstep {

Result<ServerSocket> listen_for_monitor(const std::string& address) {
  if (!has_http_server()) {
    return problem("--monitor: this lockstep was built without it",
                   "build it with libmicrohttpd and -DLOCKSTEP_MONITOR=ON");
  }
  auto socket = listen_on(address);
  if (!socket) return problem("--monitor: " + socket.error().message, socket.error().hint);
  return socket;
}

MonitorLink::MonitorLink(const std::string& link, const std::string& file, bool opens)
    : registration_(link, file) {
  messages().say("monitor: " + link + "\n");
  if (opens && !open_in_browser(link)) {
    messages().say("lockstep: warning: --monitor-open: there is no xdg-open\n");
  }
}

}  // namespace lockstep

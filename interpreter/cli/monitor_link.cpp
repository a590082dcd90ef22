#include "cli/monitor_link.h"

#include "base/terminal/outlet.h"
#include "show/web/browser.h"
#include "show/web/http_server.h"

namespace lockstep::host {

namespace {

// Returns the result of `make`, if this build has a monitor. An error names the option.
template <class Make>
auto if_built(const std::string& option, Make make) -> decltype(make()) {
  if (!has_http_server()) {
    return problem(option + ": this lockstep was built without it",
                   "build it with libmicrohttpd and -DLOCKSTEP_MONITOR=ON");
  }
  auto made = make();
  if (!made) return problem(option + ": " + made.error().message, made.error().hint);
  return made;
}

}  // namespace

Result<ServerSocket> listen_for_monitor(const std::string& address) {
  return if_built("--monitor", [&] { return listen_on(address); });
}

Result<AttachSocket> make_monitor_socket(const std::string& path) {
  return if_built("--monitor-socket", [&] { return AttachSocket::at(path); });
}

void MonitorLink::tell(const std::string& link, bool opens) {
  registration_.set_link(link);
  if (!registration_.is_listed()) {
    messages().say(
        "lockstep: warning: other commands do not find this run: its file in XDG_RUNTIME_DIR or "
        "/tmp cannot be written, or another container has a run with its process number\n");
  }
  messages().say("monitor: " + link + "\n");
  if (opens && !open_in_browser(link)) {
    messages().say("lockstep: warning: --monitor-open: there is no xdg-open\n");
  }
}

}  // namespace lockstep::host

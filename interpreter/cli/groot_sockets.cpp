#include "cli/groot_sockets.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "core/diagnostics.h"
#include "core/value.h"
#include "runtime/outlet.h"
#include "web/server_socket.h"

namespace lockstep {
namespace {

constexpr std::int64_t kLargestPort = 65535;
// Tries for a free port whose next one is free too.
constexpr int kTries = 50;

struct Pair {
  ServerSocket requests, events;
};

std::string_view port_of(std::string_view address) {
  return address.substr(address.rfind(':') + 1);
}

Result<Pair> listen_on_pair(const std::string& address) {
  auto requests = listen_on(address);
  if (!requests) return tl::unexpected(std::move(requests.error()));
  const std::int64_t port = *parse_int(port_of(requests->address));
  if (port == kLargestPort) {
    return problem(fmt::format("'{}' is not an address", printable(address)),
                   "the port after it is needed too: the largest is 65534");
  }
  const std::string name = requests->name.find(':') == std::string::npos
                               ? requests->name
                               : fmt::format("[{}]", requests->name);
  auto events = listen_on(fmt::format("{}:{}", name, port + 1));
  if (!events) {
    return problem(events.error().message, "the port after the given one is needed too");
  }
  return Pair{std::move(*requests), std::move(*events)};
}

Result<Pair> listen_on_any_pair(const std::string& address) {
  const bool is_any = parse_int(port_of(address)) == 0;
  auto pair = listen_on_pair(address);
  for (int tries = 1; !pair && is_any && tries < kTries; ++tries) pair = listen_on_pair(address);
  return pair;
}

}  // namespace

Result<GrootSockets> listen_for_groot(const std::string& address) {
  if (!has_groot_sockets()) {
    return problem("--groot2: this lockstep was built without it",
                   "build it with libzmq and -DLOCKSTEP_GROOT2=ON");
  }
  auto pair = listen_on_any_pair(address);
  if (!pair) return problem("--groot2: " + pair.error().message, pair.error().hint);
  const std::string& shown = pair->requests.address;
  if (!pair->requests.is_loopback) {
    messages().say(fmt::format(
        "lockstep: warning: --groot2: '{}' can be reached from other machines, and its protocol "
        "asks nobody for a password\n",
        shown));
  }
  messages().say(fmt::format("groot2: {}\n", shown));
  try {
    return GrootSockets(std::move(pair->requests.socket), std::move(pair->events.socket));
  } catch (const std::runtime_error& error) {
    return problem(std::string("--groot2: ") + error.what());
  }
}

}  // namespace lockstep

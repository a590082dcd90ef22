#include "cli/run/groot.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "core/diagnostics.h"
#include "core/value.h"
#include "groot/publisher.h"
#include "runtime/outlet.h"
#include "web/server_socket.h"

namespace lockstep::host {
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

class Listener final : public GrootListener {
 public:
  Listener(GrootTree shown, GrootSockets sockets)
      : shown_(std::move(shown)), sockets_(std::move(sockets)) {}

  std::unique_ptr<Observer> show(const Tree& tree, RunControl* control,
                                 std::function<void(const std::string& line)> print) override {
    GrootOptions options{.shown = std::move(shown_), .control = control, .print = std::move(print)};
    return std::make_unique<GrootPublisher>(tree, std::move(options), std::move(sockets_));
  }

 private:
  GrootTree shown_;
  GrootSockets sockets_;
};

// Throws std::runtime_error where ZeroMQ does not start.
Result<std::unique_ptr<GrootListener>> listen(const std::string& address,
                                              const Definition& definition) {
  auto shown = groot_tree(definition);
  if (!shown) return tl::unexpected(std::move(shown.error()));
  auto pair = listen_on_any_pair(address);
  if (!pair) return tl::unexpected(std::move(pair.error()));
  auto& [requests, events] = *pair;
  GrootSockets sockets(std::move(requests.socket), std::move(events.socket));
  if (!requests.is_loopback) {
    messages().say(fmt::format(
        "lockstep: warning: --groot2: '{}' can be reached from other machines, and its protocol "
        "asks nobody for a password\n",
        requests.address));
  }
  messages().say(fmt::format("groot2: {}\n", requests.address));
  return std::make_unique<Listener>(std::move(*shown), std::move(sockets));
}

}  // namespace

Result<std::unique_ptr<GrootListener>> listen_for_groot(const std::string& address,
                                                        const Definition& definition) {
  try {
    auto listener = listen(address, definition);
    if (listener) return listener;
    return problem("--groot2: " + listener.error().message, listener.error().hint);
  } catch (const std::runtime_error& error) {
    return problem(std::string("--groot2: ") + error.what());
  }
}

}  // namespace lockstep::host

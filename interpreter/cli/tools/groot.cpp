#include "cli/run/groot.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "base/terminal/outlet.h"
#include "groot/publisher.h"
#include "show/web/server_socket.h"

namespace lockstep::host {
namespace {

class Listener final : public GrootListener {
 public:
  Listener(GrootTree shown, GrootSockets sockets)
      : shown_(std::move(shown)), sockets_(std::move(sockets)) {}

  std::unique_ptr<Observer> show(const Shape& shape, RunControl* control,
                                 std::function<void(const std::string& line)> print) override {
    GrootOptions options{.shown = std::move(shown_), .control = control, .print = std::move(print)};
    return std::make_unique<GrootPublisher>(shape, std::move(options), std::move(sockets_));
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
  auto pair = listen_on_pair(address);
  if (!pair) return tl::unexpected(std::move(pair.error()));
  auto& [requests, events] = *pair;
  GrootSockets sockets(std::move(requests.socket), std::move(events.socket));
  if (!requests.is_loopback) {
    messages().say(
        fmt::format("lockstep: warning: --groot2: '{}' can be reached from other machines, and its "
                    "protocol has no password\n",
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

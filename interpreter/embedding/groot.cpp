#include "embedding/groot.h"

#include "groot/publisher.h"
#include "groot/tree.h"
#include "run/shape_of.h"
#include "show/web/server_socket.h"

namespace lockstep::host::embedding {

std::shared_ptr<const GrootTree> groot_of(const Definition& definition) {
  auto shown = groot_tree(definition);
  return shown ? std::make_shared<const GrootTree>(std::move(*shown)) : nullptr;
}

// Throws std::runtime_error where ZeroMQ does not start.
Result<std::unique_ptr<Observer>> show_groot(const Tree& tree, const GrootTree& shown,
                                             const std::string& address) {
  auto sockets = listen_on_pair(address);
  if (!sockets) return tl::unexpected(std::move(sockets.error()));
  GrootOptions options{.shown = shown, .control = nullptr, .print = [](const std::string&) {}};
  return std::make_unique<GrootPublisher>(
      shape_of(tree), std::move(options),
      GrootSockets(std::move(sockets->first.socket), std::move(sockets->second.socket)));
}

}  // namespace lockstep::host::embedding

#include "groot/connection_guard.h"

#include <fcntl.h>
#include <linux/tcp.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <optional>

#include "base/system/file_descriptor.h"

namespace lockstep::host {
namespace {

// Stays the same connection, whatever becomes of the descriptor.
FileDescriptor copy_of(int descriptor) {
  return FileDescriptor(fcntl(descriptor, F_DUPFD_CLOEXEC, 0));
}

using NameOf = int (*)(int, sockaddr*, socklen_t*);

// Nothing: it is no connection, or no longer one.
std::optional<std::uint16_t> port(NameOf name_of, const FileDescriptor& socket) {
  sockaddr_storage name{};
  socklen_t size = sizeof name;
  if (name_of(socket.number(), reinterpret_cast<sockaddr*>(&name), &size) != 0) return {};
  if (name.ss_family == AF_INET) return reinterpret_cast<const sockaddr_in*>(&name)->sin_port;
  if (name.ss_family == AF_INET6) return reinterpret_cast<const sockaddr_in6*>(&name)->sin6_port;
  return std::nullopt;
}

std::uint64_t received(const FileDescriptor& socket) {
  tcp_info info{};
  socklen_t size = sizeof info;
  getsockopt(socket.number(), IPPROTO_TCP, TCP_INFO, &info, &size);
  return info.tcpi_bytes_received;
}

// Both sides see the end at once. After shutdown() a client whose window is full would not.
void cut_off(const FileDescriptor& socket) {
  const sockaddr nobody{.sa_family = AF_UNSPEC, .sa_data = {}};
  static_cast<void>(connect(socket.number(), &nobody, sizeof nobody));
}

}  // namespace

void ConnectionGuard::accepted(int descriptor, Nanoseconds now) {
  const FileDescriptor socket = copy_of(descriptor);
  const auto own = port(getsockname, socket), peer = port(getpeername, socket);
  if (!own || !peer || std::ranges::find(ports_, *own) == ports_.end()) return;
  if (connections_.size() >= kMost) forget_closed();
  if (connections_.size() >= kMost) return cut_off(socket);
  connections_.insert_or_assign(descriptor, Connection{*peer, 0, now});
}

void ConnectionGuard::heard(int descriptor, Nanoseconds now) {
  const auto found = connections_.find(descriptor);
  if (found == connections_.end()) return;
  found->second.heard = received(copy_of(descriptor));
  found->second.heard_at = now;
}

void ConnectionGuard::look(Nanoseconds now) {
  forget_closed();
  for (const auto& [descriptor, it] : connections_) {
    const FileDescriptor socket = copy_of(descriptor);
    if (port(getpeername, socket) != it.peer) continue;
    const double signs_of_life = to_seconds(now - it.heard_at) * kPerSecond;
    const auto allowed = it.heard + kUnheard + static_cast<std::uint64_t>(signs_of_life);
    if (received(socket) > allowed) cut_off(socket);
  }
}

void ConnectionGuard::forget_closed() {
  std::erase_if(connections_, [](const auto& it) {
    return port(getpeername, copy_of(it.first)) != it.second.peer;
  });
}

}  // namespace lockstep::host

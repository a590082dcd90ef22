#include "show/web/server_socket.h"

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <memory>
#include <optional>
#include <system_error>

#include "base/core/diagnostics.h"
#include "base/core/value.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kHint = "ADDRESS:PORT, as 127.0.0.1:8080; port 0 is a free one";

struct HostAndPort {
  std::string host, port;
};

bool is_number(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

std::optional<HostAndPort> split(std::string_view text) {
  if (is_number(text)) return HostAndPort{"127.0.0.1", std::string(text)};
  const auto colon = text.rfind(':');
  if (colon == std::string_view::npos || !is_number(text.substr(colon + 1))) return std::nullopt;
  std::string_view host = text.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) {
    host = host.substr(1, host.size() - 2);
  } else if (host.find(':') != std::string_view::npos) {
    return std::nullopt;
  }
  return HostAndPort{std::string(host.empty() ? "127.0.0.1" : host),
                     std::string(text.substr(colon + 1))};
}

bool is_loopback(const sockaddr* address) {
  if (address->sa_family == AF_INET) {
    const auto* it = reinterpret_cast<const sockaddr_in*>(address);
    return ntohl(it->sin_addr.s_addr) >> 24 == 127;
  }
  return IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr);
}

// As in a link.
std::string text_of(const sockaddr* address, socklen_t size) {
  char host[NI_MAXHOST] = "", port[NI_MAXSERV] = "";
  getnameinfo(address, size, host, sizeof host, port, sizeof port, NI_NUMERICHOST | NI_NUMERICSERV);
  return address->sa_family == AF_INET6 ? fmt::format("[{}]:{}", host, port)
                                        : fmt::format("{}:{}", host, port);
}

std::string address_of(int socket) {
  sockaddr_storage own{};
  socklen_t size = sizeof own;
  getsockname(socket, reinterpret_cast<sockaddr*>(&own), &size);
  return text_of(reinterpret_cast<const sockaddr*>(&own), size);
}

// The digits of a port. getaddrinfo takes larger numbers, and another port for them.
bool is_port(std::string_view digits) {
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  return error == std::errc() && end == digits.data() + digits.size();
}

// Closed ones of the last run may still be around: without SO_REUSEADDR their port is not free.
bool open(const addrinfo& it, FileDescriptor& socket) {
  socket = FileDescriptor(
      ::socket(it.ai_family, it.ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, it.ai_protocol));
  const int on = 1;
  return socket.number() >= 0 &&
         setsockopt(socket.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0 &&
         bind(socket.number(), it.ai_addr, it.ai_addrlen) == 0 &&
         listen(socket.number(), SOMAXCONN) == 0;
}

struct Found {
  std::string shown, host;  // the text, and what of it is the name
  std::unique_ptr<addrinfo, void (*)(addrinfo*)> addresses{nullptr, freeaddrinfo};
};

Result<Found> look_up(std::string_view address_and_port, int flags) {
  const auto place = split(address_and_port);
  const std::string shown = printable(address_and_port);
  if (!place) {
    return problem(fmt::format("'{}' is not an address", shown), std::string(kHint));
  }
  if (!is_port(place->port)) {
    return problem(fmt::format("'{}' is not an address", shown), "the largest port is 65535");
  }
  addrinfo wanted{};
  wanted.ai_flags = AI_PASSIVE | AI_NUMERICSERV | flags;
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int error = getaddrinfo(place->host.c_str(), place->port.c_str(), &wanted, &found);
      error != 0) {
    return problem(fmt::format("cannot listen on '{}': {}", shown, gai_strerror(error)),
                   std::string(kHint));
  }
  Found result{.shown = shown, .host = place->host};
  result.addresses.reset(found);
  return result;
}

Result<ServerSocket> listen_at(const Found& found) {
  ServerSocket listener;
  if (!open(*found.addresses, listener.socket)) {
    return problem(fmt::format("cannot listen on '{}': {}", found.shown,
                               std::generic_category().message(errno)),
                   "another port, or 0 for a free one");
  }
  listener.name = found.host;
  listener.address = address_of(listener.socket.number());
  listener.is_loopback = is_loopback(found.addresses->ai_addr);
  return listener;
}

constexpr std::int64_t kLargestPort = 65535;
// Tries for a free port whose next one is free too.
constexpr int kTries = 50;

std::string_view port_of(std::string_view address) {
  return address.substr(address.rfind(':') + 1);
}

Result<ServerSockets> try_pair(const std::string& address) {
  auto first = listen_on(address);
  if (!first) return tl::unexpected(std::move(first.error()));
  const std::int64_t port = *parse_int(port_of(first->address));
  if (port == kLargestPort) {
    return problem(fmt::format("'{}' is not an address", printable(address)),
                   "the port after it is needed too: the largest is 65534");
  }
  const std::string name =
      first->name.find(':') == std::string::npos ? first->name : fmt::format("[{}]", first->name);
  auto second = listen_on(fmt::format("{}:{}", name, port + 1));
  if (!second) {
    return problem(second.error().message, "the port after the given one is needed too");
  }
  return ServerSockets{std::move(*first), std::move(*second)};
}

}  // namespace

Result<ServerSockets> listen_on_pair(const std::string& address_and_port) {
  const bool is_any = parse_int(port_of(address_and_port)) == 0;
  auto pair = try_pair(address_and_port);
  for (int tries = 1; !pair && is_any && tries < kTries; ++tries) {
    pair = try_pair(address_and_port);
  }
  return pair;
}

bool looks_like_address(std::string_view text) {
  return text.find('/') == std::string_view::npos && split(text).has_value();
}

Result<ServerSocket> listen_on(std::string_view address_and_port) {
  const auto found = look_up(address_and_port, 0);
  if (!found) return tl::unexpected(found.error());
  return listen_at(*found);
}

Result<std::string> resolve(std::string_view address_and_port) {
  const auto found = look_up(address_and_port, 0);
  if (!found) return tl::unexpected(found.error());
  const addrinfo& it = *found->addresses;
  return fmt::format("{} {}", text_of(it.ai_addr, it.ai_addrlen), found->host);
}

Result<ServerSocket> listen_on_resolved(std::string_view resolved) {
  const auto blank = resolved.find(' ');
  auto found = look_up(resolved.substr(0, blank), AI_NUMERICHOST);
  if (!found) return tl::unexpected(found.error());
  if (blank != std::string_view::npos) found->host = resolved.substr(blank + 1);
  return listen_at(*found);
}

}  // namespace lockstep::host

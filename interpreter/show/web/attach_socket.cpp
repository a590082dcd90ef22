#include "show/web/attach_socket.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <optional>
#include <string_view>
#include <system_error>

#include "base/core/diagnostics.h"
#include "show/web/server_socket.h"

namespace lockstep::host {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kLongestPacket = 64 << 10;  // bytes
// The asker has sent its packet before the run looks; one that has not does not get in the way.
constexpr milliseconds kAskerTakes{100};
constexpr milliseconds kRunTakes{5000};

// The first byte of an answer.
constexpr char kGiven = '+', kRefused = '-';

Problem cannot(std::string_view what, const std::string& path) {
  return {fmt::format("cannot {} '{}': {}", what, printable(path),
                      std::generic_category().message(errno))};
}

FileDescriptor make_socket() {
  return FileDescriptor(socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
}

// Nothing: the path is empty, which would be a name of no file, or too long.
std::optional<sockaddr_un> unix_address(const std::string& path) {
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  if (path.empty()) {
    errno = ENOENT;
    return std::nullopt;
  }
  if (path.size() >= sizeof address.sun_path) {
    errno = ENAMETOOLONG;
    return std::nullopt;
  }
  std::ranges::copy(path, address.sun_path);
  return address;
}

bool connect_to(int socket, const sockaddr_un& address) {
  return connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
}

// True if it is a socket on which nobody listens.
bool is_left_over(const sockaddr_un& address) {
  struct stat status {};
  if (lstat(address.sun_path, &status) != 0 || !S_ISSOCK(status.st_mode)) return false;
  const FileDescriptor probe = make_socket();
  return !connect_to(probe.number(), address) && errno == ECONNREFUSED;
}

bool bind_to(int socket, const sockaddr_un& address) {
  const mode_t mask = umask(S_IXUSR | S_IRWXG | S_IRWXO);
  const bool is_bound =
      bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  const int error = errno;
  umask(mask);
  errno = error;
  return is_bound;
}

bool is_readable(int socket, milliseconds longest) {
  pollfd file{socket, POLLIN, 0};
  return poll(&file, 1, static_cast<int>(longest.count())) == 1;
}

// "": nothing came, or too much.
std::string receive(int socket) {
  std::string packet(kLongestPacket, '\0');
  const ssize_t size = recv(socket, packet.data(), packet.size(), MSG_TRUNC);
  if (size <= 0 || static_cast<std::size_t>(size) > packet.size()) return {};
  packet.resize(static_cast<std::size_t>(size));
  return packet;
}

bool send_packet(int socket, const std::string& packet) {
  const std::size_t size = std::min(packet.size(), kLongestPacket);
  return send(socket, packet.data(), size, MSG_NOSIGNAL | MSG_DONTWAIT) >= 0;
}

}  // namespace

Result<AttachSocket> AttachSocket::at(const std::string& path) {
  const auto address = unix_address(path);
  if (!address) return tl::unexpected(cannot("make", path));
  FileDescriptor socket = make_socket();
  bool is_bound = bind_to(socket.number(), *address);
  if (!is_bound && errno == EADDRINUSE) {
    if (!is_left_over(*address)) return problem(fmt::format("'{}' exists", printable(path)));
    unlink(path.c_str());
    is_bound = bind_to(socket.number(), *address);
  }
  if (!is_bound || listen(socket.number(), SOMAXCONN) != 0) {
    return tl::unexpected(cannot("make", path));
  }
  return AttachSocket(std::move(socket), path);
}

AttachSocket::~AttachSocket() {
  if (socket_.number() >= 0) unlink(path_.c_str());
}

void AttachSocket::answer(
    const std::function<Result<std::string>(const std::string& request)>& answer) {
  const FileDescriptor asker(accept4(socket_.number(), nullptr, nullptr, SOCK_CLOEXEC));
  if (asker.number() < 0 || !is_readable(asker.number(), kAskerTakes)) return;
  const std::string request = receive(asker.number());
  if (request.empty()) return;
  const auto given = answer(request);
  const Problem refused = given ? Problem() : given.error();
  send_packet(asker.number(),
              given ? kGiven + *given : kRefused + refused.message + '\n' + refused.hint);
}

Result<std::string> attach(const std::string& path, const std::string& address) {
  const auto resolved = resolve(address);
  if (!resolved) return tl::unexpected(resolved.error());
  return ask_run(path, *resolved);
}

Result<std::string> ask_run(const std::string& path, const std::string& request) {
  const auto place = unix_address(path);
  const FileDescriptor socket = make_socket();
  if (!place || !connect_to(socket.number(), *place)) {
    return tl::unexpected(cannot("reach the run at", path));
  }
  if (!send_packet(socket.number(), request)) {
    return tl::unexpected(cannot("reach the run at", path));
  }
  const std::string answer =
      is_readable(socket.number(), kRunTakes) ? receive(socket.number()) : std::string();
  if (answer.starts_with(kGiven)) return answer.substr(1);
  if (!answer.starts_with(kRefused)) {
    return problem(fmt::format("the run at '{}' does not answer", printable(path)));
  }
  const auto end = answer.find('\n');
  return problem(answer.substr(1, end - 1), end == std::string::npos ? "" : answer.substr(end + 1));
}

}  // namespace lockstep::host

// The socket on which the monitor is reached.
#pragma once

#include <string>
#include <string_view>

#include "base/core/problem.h"
#include "base/system/file_descriptor.h"

namespace lockstep::host {

struct ServerSocket {
  FileDescriptor socket;
  std::string name;         // of the host, as it was given
  std::string address;      // as in a link: "127.0.0.1:8080", "[::1]:8080"
  bool is_loopback = true;  // no other machine can reach it
};

// An address that only this machine reaches, with a free port.
constexpr std::string_view kAnyLoopback = "127.0.0.1:0";

// True if it looks like what listen_on accepts, rather than like a file.
bool looks_like_address(std::string_view text);

// "ADDRESS:PORT", "[IPV6]:PORT", ":PORT" or "PORT". Without an address, that of this machine that
// no other can reach; port 0: one that is free.
Result<ServerSocket> listen_on(std::string_view address_and_port);

// Two of them: the second has the port after that of the first.
struct ServerSockets {
  ServerSocket first, second;
};
Result<ServerSockets> listen_on_pair(const std::string& address_and_port);

// For a process that must not wait for a name server: another one asks it, and passes on the
// result, "192.0.2.1:8080 robot".
Result<std::string> resolve(std::string_view address_and_port);
Result<ServerSocket> listen_on_resolved(std::string_view resolved);

}  // namespace lockstep::host

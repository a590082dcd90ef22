// Cuts off clients that send more than Groot2 ever would. ZeroMQ keeps the parts of a message until
// the last one has come, and has no limit for all of them together, nor for connections.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/core/clock.h"

namespace lockstep::host {

class ConnectionGuard {
 public:
  static constexpr std::size_t kMost = 64;               // connections
  static constexpr std::uint64_t kUnheard = 256u << 10;  // bytes that are no whole message
  static constexpr std::uint64_t kPerSecond = 1u << 10;  // and these: signs of life

  // Only of connections to these ports of this machine, in the order of the network.
  explicit ConnectionGuard(std::vector<std::uint16_t> ports) : ports_(std::move(ports)) {}

  // There is a connection. Its descriptor belongs to somebody else, who may close it at any time.
  void accepted(int descriptor, Nanoseconds now);
  // A whole message has come through it.
  void heard(int descriptor, Nanoseconds now);
  // Cuts off those that have sent too much.
  void look(Nanoseconds now);
  bool has_any() const { return !connections_.empty(); }

 private:
  struct Connection {
    std::uint16_t peer;   // its port: another one is another connection
    std::uint64_t heard;  // bytes that had come when the last message had
    Nanoseconds heard_at{0};
  };
  void forget_closed();

  const std::vector<std::uint16_t> ports_;
  std::map<int, Connection> connections_;  // by descriptor
};

}  // namespace lockstep::host

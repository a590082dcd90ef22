// In place of zmq_sockets.cpp, where ZeroMQ is not there.
#include "groot/sockets.h"

namespace lockstep {

struct GrootSockets::Implementation {};

bool has_groot_sockets() {
  return false;
}

GrootSockets::GrootSockets(FileDescriptor, FileDescriptor) {}
GrootSockets::~GrootSockets() = default;
GrootSockets::GrootSockets(GrootSockets&&) noexcept = default;
GrootSockets& GrootSockets::operator=(GrootSockets&&) noexcept = default;
std::optional<GrootMessage> GrootSockets::receive(int, std::chrono::milliseconds) {
  return std::nullopt;
}
void GrootSockets::reply(const GrootMessage&) {}
void GrootSockets::publish(const GrootMessage&) {}

}  // namespace lockstep

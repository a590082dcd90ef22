#include <fcntl.h>
#include <zmq.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "groot/sockets.h"

namespace lockstep {
namespace {

// A request is larger only if it is not one of Groot2.
constexpr std::int64_t kLargest = 64 << 10;  // bytes of a part
constexpr std::size_t kMostParts = 8;
constexpr int kQueue = 16;     // messages for or from one client
constexpr int kLinger = 200;   // ms
constexpr int kHandshake = 2;  // s

struct CloseContext {
  void operator()(void* it) const { zmq_ctx_term(it); }
};
struct CloseSocket {
  void operator()(void* it) const { zmq_close(it); }
};
using Context = std::unique_ptr<void, CloseContext>;
using Socket = std::unique_ptr<void, CloseSocket>;

[[noreturn]] void fail(const char* what) {
  throw std::runtime_error(std::string("ZeroMQ: ") + what + ": " + zmq_strerror(zmq_errno()));
}

template <class T>
void set(const Socket& socket, int option, T value) {
  if (zmq_setsockopt(socket.get(), option, &value, sizeof value) != 0) fail("an option");
}

// It closes the descriptor.
Socket listening(const Context& context, int type, FileDescriptor listener) {
  Socket socket(zmq_socket(context.get(), type));
  if (socket == nullptr) fail("a socket");
  set(socket, ZMQ_LINGER, kLinger);
  set(socket, ZMQ_MAXMSGSIZE, kLargest);
  set(socket, ZMQ_RCVHWM, kQueue);
  set(socket, ZMQ_SNDHWM, kQueue);
  set(socket, ZMQ_HANDSHAKE_IVL, kHandshake * 1000);
  set(socket, ZMQ_IPV6, 1);
  set(socket, ZMQ_USE_FD, fcntl(listener.number(), F_DUPFD_CLOEXEC, 0));
  if (zmq_bind(socket.get(), "tcp://127.0.0.1:*") != 0) fail("listening");
  return socket;
}

void send(const Socket& socket, const GrootMessage& message) {
  for (std::size_t part = 0; part < message.size(); ++part) {
    const int more = part + 1 < message.size() ? ZMQ_SNDMORE : 0;
    zmq_send(socket.get(), message[part].data(), message[part].size(), ZMQ_DONTWAIT | more);
  }
}

}  // namespace

struct GrootSockets::Implementation {
  Context context;
  Socket requests, events;
};

bool has_groot_sockets() {
  return true;
}

GrootSockets::GrootSockets(FileDescriptor requests, FileDescriptor events)
    : it_(std::make_unique<Implementation>()) {
  it_->context.reset(zmq_ctx_new());
  if (it_->context == nullptr) fail("a context");
  it_->requests = listening(it_->context, ZMQ_REP, std::move(requests));
  it_->events = listening(it_->context, ZMQ_PUB, std::move(events));
}

GrootSockets::~GrootSockets() = default;
GrootSockets::GrootSockets(GrootSockets&&) noexcept = default;
GrootSockets& GrootSockets::operator=(GrootSockets&&) noexcept = default;

std::optional<GrootMessage> GrootSockets::receive(int wake, std::chrono::milliseconds longest) {
  std::array<zmq_pollitem_t, 2> items{
      {{it_->requests.get(), -1, ZMQ_POLLIN, 0}, {nullptr, wake, ZMQ_POLLIN, 0}}};
  zmq_poll(items.data(), static_cast<int>(items.size()), static_cast<long>(longest.count()));
  GrootMessage message;
  for (bool has_more = true; has_more;) {
    zmq_msg_t part;
    zmq_msg_init(&part);
    if (zmq_msg_recv(&part, it_->requests.get(), ZMQ_DONTWAIT) < 0) {
      zmq_msg_close(&part);
      return std::nullopt;
    }
    if (message.size() < kMostParts) {
      message.emplace_back(static_cast<const char*>(zmq_msg_data(&part)), zmq_msg_size(&part));
    }
    has_more = zmq_msg_more(&part) != 0;
    zmq_msg_close(&part);
  }
  return message;
}

void GrootSockets::reply(const GrootMessage& message) {
  send(it_->requests, message);
}

void GrootSockets::publish(const GrootMessage& message) {
  send(it_->events, message);
}

}  // namespace lockstep

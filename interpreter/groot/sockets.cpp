#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <zmq.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/system/late_library.h"
#include "groot/connection_guard.h"
#include "groot/sockets.h"

namespace lockstep::host {
namespace {

struct ZeroMq : LateLibrary {
  ZeroMq() : LateLibrary(LOCKSTEP_ZMQ) {}

  decltype(&zmq_bind) bind = function("zmq_bind");
  decltype(&zmq_close) close = function("zmq_close");
  decltype(&zmq_connect) connect = function("zmq_connect");
  decltype(&zmq_ctx_new) ctx_new = function("zmq_ctx_new");
  decltype(&zmq_ctx_term) ctx_term = function("zmq_ctx_term");
  decltype(&zmq_errno) last_error = function("zmq_errno");
  decltype(&zmq_msg_close) msg_close = function("zmq_msg_close");
  decltype(&zmq_msg_data) msg_data = function("zmq_msg_data");
  decltype(&zmq_msg_get) msg_get = function("zmq_msg_get");
  decltype(&zmq_msg_init) msg_init = function("zmq_msg_init");
  decltype(&zmq_msg_more) msg_more = function("zmq_msg_more");
  decltype(&zmq_msg_recv) msg_recv = function("zmq_msg_recv");
  decltype(&zmq_msg_size) msg_size = function("zmq_msg_size");
  decltype(&zmq_poll) poll = function("zmq_poll");
  decltype(&zmq_send) send = function("zmq_send");
  decltype(&zmq_setsockopt) setsockopt = function("zmq_setsockopt");
  decltype(&zmq_socket) socket = function("zmq_socket");
  decltype(&zmq_socket_monitor) socket_monitor = function("zmq_socket_monitor");
  decltype(&zmq_strerror) strerror = function("zmq_strerror");
};

const ZeroMq& zmq() {
  static const ZeroMq library;
  return library;
}

// A request is larger only if it is not one of Groot2.
constexpr std::int64_t kLargest = 64 << 10;  // bytes of a part
constexpr std::size_t kMostParts = 8;
constexpr int kQueue = 16;        // messages for or from one client
constexpr int kLinger = 200;      // ms
constexpr int kHandshake = 2000;  // ms
// How often clients that are there are looked at.
constexpr std::chrono::milliseconds kGlance{20};

struct CloseContext {
  void operator()(void* it) const { zmq().ctx_term(it); }
};
struct CloseSocket {
  void operator()(void* it) const { zmq().close(it); }
};
using Context = std::unique_ptr<void, CloseContext>;
using Socket = std::unique_ptr<void, CloseSocket>;

[[noreturn]] void fail(const char* what) {
  throw std::runtime_error(std::string("ZeroMQ: ") + what + ": " +
                           zmq().strerror(zmq().last_error()));
}

template <class T>
void set(const Socket& socket, int option, T value) {
  if (zmq().setsockopt(socket.get(), option, &value, sizeof value) != 0) fail("an option");
}

Socket new_socket(const Context& context, int type) {
  Socket socket(zmq().socket(context.get(), type));
  if (socket == nullptr) fail("a socket");
  return socket;
}

// It takes the listener.
Socket listening(const Context& context, int type, const FileDescriptor& listener) {
  Socket socket = new_socket(context, type);
  set(socket, ZMQ_LINGER, kLinger);
  set(socket, ZMQ_MAXMSGSIZE, kLargest);
  set(socket, ZMQ_RCVHWM, kQueue);
  set(socket, ZMQ_SNDHWM, kQueue);
  set(socket, ZMQ_HANDSHAKE_IVL, kHandshake);
  set(socket, ZMQ_IPV6, 1);
  set(socket, ZMQ_USE_FD, fcntl(listener.number(), F_DUPFD_CLOEXEC, 0));
  return socket;
}

void listen(const Socket& socket) {
  if (zmq().bind(socket.get(), "tcp://127.0.0.1:*") != 0) fail("listening");
}

// Hears of the connections of a socket that does not listen yet.
Socket watching(const Context& context, const Socket& socket, const char* name) {
  if (zmq().socket_monitor(socket.get(), name, ZMQ_EVENT_ACCEPTED) != 0) fail("watching");
  Socket watcher = new_socket(context, ZMQ_PAIR);
  set(watcher, ZMQ_RCVHWM, 0);  // else the threads of ZeroMQ would wait for it
  if (zmq().connect(watcher.get(), name) != 0) fail("watching");
  return watcher;
}

std::uint16_t port_of(const FileDescriptor& listener) {
  sockaddr_storage name{};
  socklen_t size = sizeof name;
  getsockname(listener.number(), reinterpret_cast<sockaddr*>(&name), &size);
  // The port is at the same place for IPv4 and for IPv6.
  return reinterpret_cast<const sockaddr_in*>(&name)->sin_port;
}

void send(const Socket& socket, const GrootMessage& message) {
  for (std::size_t part = 0; part < message.size(); ++part) {
    const int more = part + 1 < message.size() ? ZMQ_SNDMORE : 0;
    zmq().send(socket.get(), message[part].data(), message[part].size(), ZMQ_DONTWAIT | more);
  }
}

// A part of a message; nothing: there is none.
struct Part {
  Part() { zmq().msg_init(&it); }
  ~Part() { zmq().msg_close(&it); }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  bool receive(const Socket& socket) {
    return zmq().msg_recv(&it, socket.get(), ZMQ_DONTWAIT) >= 0;
  }
  std::string_view bytes() {
    return {static_cast<const char*>(zmq().msg_data(&it)), zmq().msg_size(&it)};
  }
  bool is_last() { return zmq().msg_more(&it) == 0; }
  int source() { return zmq().msg_get(&it, ZMQ_SRCFD); }

  zmq_msg_t it;
};

}  // namespace

struct GrootSockets::Implementation {
  explicit Implementation(std::vector<std::uint16_t> ports) : guard(std::move(ports)) {}
  // Else the threads of ZeroMQ would go on to tell who is no longer there.
  ~Implementation() {
    for (const Socket* socket : {&requests, &events}) {
      if (*socket != nullptr) zmq().socket_monitor(socket->get(), nullptr, 0);
    }
  }

  void take_connections() {
    for (const Socket* watcher : {&request_watcher, &event_watcher}) {
      for (Part event, address; event.receive(*watcher) && address.receive(*watcher);) {
        std::uint32_t descriptor = 0;  // behind the 16 bits that say what has happened
        if (event.bytes().size() < 6) continue;
        std::memcpy(&descriptor, event.bytes().data() + 2, sizeof descriptor);
        guard.accepted(static_cast<int>(descriptor), monotonic_now());
      }
    }
    guard.look(monotonic_now());
  }

  Context context;
  Socket requests, events;
  Socket request_watcher, event_watcher;
  ConnectionGuard guard;
};

GrootSockets::GrootSockets(FileDescriptor requests, FileDescriptor events)
    : it_(std::make_unique<Implementation>(
          std::vector<std::uint16_t>{port_of(requests), port_of(events)})) {
  it_->context.reset(zmq().ctx_new());
  if (it_->context == nullptr) fail("a context");
  it_->requests = listening(it_->context, ZMQ_REP, requests);
  it_->events = listening(it_->context, ZMQ_PUB, events);
  it_->request_watcher = watching(it_->context, it_->requests, "inproc://requests");
  it_->event_watcher = watching(it_->context, it_->events, "inproc://events");
  listen(it_->requests);
  listen(it_->events);
}

GrootSockets::~GrootSockets() = default;
GrootSockets::GrootSockets(GrootSockets&&) noexcept = default;
GrootSockets& GrootSockets::operator=(GrootSockets&&) noexcept = default;

std::optional<GrootMessage> GrootSockets::receive(int wake, std::chrono::milliseconds longest) {
  const auto wait = it_->guard.has_any() ? std::min(longest, kGlance) : longest;
  std::array<zmq_pollitem_t, 4> items{{{it_->requests.get(), -1, ZMQ_POLLIN, 0},
                                       {it_->request_watcher.get(), -1, ZMQ_POLLIN, 0},
                                       {it_->event_watcher.get(), -1, ZMQ_POLLIN, 0},
                                       {nullptr, wake, ZMQ_POLLIN, 0}}};
  zmq().poll(items.data(), static_cast<int>(items.size()), static_cast<long>(wait.count()));
  it_->take_connections();
  GrootMessage message;
  while (true) {
    Part part;
    if (!part.receive(it_->requests)) return std::nullopt;
    if (message.size() < kMostParts) message.emplace_back(part.bytes());
    if (!part.is_last()) continue;
    it_->guard.heard(part.source(), monotonic_now());
    return message;
  }
}

void GrootSockets::reply(const GrootMessage& message) {
  send(it_->requests, message);
}

void GrootSockets::publish(const GrootMessage& message) {
  send(it_->events, message);
}

}  // namespace lockstep::host

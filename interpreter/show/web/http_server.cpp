#include "show/web/http_server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <microhttpd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/core/clock.h"
#include "base/core/value.h"
#include "base/system/late_library.h"

namespace lockstep::host {
namespace {

struct Microhttpd : LateLibrary {
  Microhttpd() : LateLibrary(LOCKSTEP_MICROHTTPD) {}

  decltype(&MHD_add_connection) add_connection = function("MHD_add_connection");
  decltype(&MHD_add_response_header) add_response_header = function("MHD_add_response_header");
  decltype(&MHD_create_response_from_buffer) create_response_from_buffer =
      function("MHD_create_response_from_buffer");
  decltype(&MHD_create_response_from_callback) create_response_from_callback =
      function("MHD_create_response_from_callback");
  decltype(&MHD_destroy_response) destroy_response = function("MHD_destroy_response");
  decltype(&MHD_get_connection_info) get_connection_info = function("MHD_get_connection_info");
  decltype(&MHD_get_daemon_info) get_daemon_info = function("MHD_get_daemon_info");
  decltype(&MHD_get_timeout) get_timeout = function("MHD_get_timeout");
  decltype(&MHD_lookup_connection_value) lookup_connection_value =
      function("MHD_lookup_connection_value");
  decltype(&MHD_queue_response) queue_response = function("MHD_queue_response");
  decltype(&MHD_resume_connection) resume_connection = function("MHD_resume_connection");
  decltype(&MHD_run) run = function("MHD_run");
  decltype(&MHD_start_daemon) start_daemon = function("MHD_start_daemon");
  decltype(&MHD_stop_daemon) stop_daemon = function("MHD_stop_daemon");
  decltype(&MHD_suspend_connection) suspend_connection = function("MHD_suspend_connection");
};

const Microhttpd& mhd() {
  static const Microhttpd library;
  return library;
}

constexpr unsigned kMostConnections = 250;
constexpr std::size_t kMostStreams = 150;  // so that other requests find a place
constexpr std::size_t kMemory = 16u
                                << 10;  // bytes of a connection: for its header, then for its body
constexpr std::size_t kMostBody = 4u << 10;  // bytes
constexpr unsigned kLongestSilence = 30;     // seconds, of a client that takes nothing
constexpr std::size_t kPiece = 8u << 10;     // bytes of a stream that are read at once
// From the first byte to the last: of a request, of the answer.
constexpr std::chrono::seconds kLongestRequest{10}, kLongestAnswer{120};
constexpr std::chrono::milliseconds kBetweenLooks{100};

std::optional<std::string> header(MHD_Connection* connection, const char* name) {
  const char* value = mhd().lookup_connection_value(connection, MHD_HEADER_KIND, name);
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

std::optional<std::uint64_t> whole_number(const char* text) {
  if (text == nullptr) return std::nullopt;
  const auto value = parse_int(text);
  return value && *value >= 0 ? std::optional<std::uint64_t>(*value) : std::nullopt;
}

WebRequest read_head(MHD_Connection* connection, const char* url, const char* method) {
  return {.method = method,
          .path = url,
          .host = header(connection, MHD_HTTP_HEADER_HOST),
          .origin = header(connection, MHD_HTTP_HEADER_ORIGIN),
          .token = header(connection, "X-Lockstep-Token"),
          .after = whole_number(
              mhd().lookup_connection_value(connection, MHD_GET_ARGUMENT_KIND, "after"))};
}

// Only a body whose length is known is read.
std::optional<WebAnswer> refuse_body(MHD_Connection* connection) {
  if (header(connection, MHD_HTTP_HEADER_TRANSFER_ENCODING)) {
    return refusal(MHD_HTTP_LENGTH_REQUIRED, {"a body must have a Content-Length"});
  }
  const auto length = header(connection, MHD_HTTP_HEADER_CONTENT_LENGTH);
  if (!length) return std::nullopt;
  const auto bytes = whole_number(length->c_str());
  if (bytes && *bytes <= kMostBody) return std::nullopt;
  return refusal(MHD_HTTP_CONTENT_TOO_LARGE,
                 {"the body is too large", fmt::format("at most {} bytes", kMostBody)});
}

}  // namespace

struct HttpServer::Implementation {
  explicit Implementation(Answering& all_answering) : answering(all_answering) {}

  // --- what libmicrohttpd calls ------------------------------------------------------------------

  // No path that the server has needs it, and %00 would cut one.
  static std::size_t keep_escapes(void*, MHD_Connection*, char* text) {
    return std::char_traits<char>::length(text);
  }

  // First with the head of a request, then with each part of its body, then at its end.
  static MHD_Result on_request(void* self, MHD_Connection* connection, const char* url,
                               const char* method, const char*, const char* data, std::size_t* size,
                               void** state) {
    auto& it = *static_cast<Implementation*>(self);
    if (*state == nullptr) {
      auto* request = new WebRequest(read_head(connection, url, method));
      *state = request;
      if (auto refusal = it.refuse(connection, *request)) return it.send(connection, *refusal);
      return MHD_YES;
    }
    auto& request = *static_cast<WebRequest*>(*state);
    if (*size == 0) return it.answer(connection, request);
    if (request.body.size() + *size > kMostBody) return MHD_NO;
    request.body.append(data, std::exchange(*size, 0));
    return MHD_YES;
  }

  static void on_completed(void* self, MHD_Connection* connection, void** state,
                           MHD_RequestTerminationCode) {
    static_cast<Implementation*>(self)->waiting.erase(connection);
    delete static_cast<WebRequest*>(std::exchange(*state, nullptr));
  }

  static void on_connection(void* self, MHD_Connection* connection, void**,
                            MHD_ConnectionNotificationCode code) {
    auto& it = *static_cast<Implementation*>(self);
    if (code == MHD_CONNECTION_NOTIFY_STARTED) {
      it.deadlines[connection] = {.at = monotonic_now() + kLongestRequest, .asks = true};
    } else {
      it.deadlines.erase(connection);
    }
  }

  struct Open {
    Open(Implementation& its_server, MHD_Connection* its_connection, std::unique_ptr<Stream> it)
        : server(its_server), connection(its_connection), stream(std::move(it)) {
      ++server.streams;
    }
    ~Open() { --server.streams; }
    Open(const Open&) = delete;
    Open& operator=(const Open&) = delete;

    Implementation& server;
    MHD_Connection* const connection;
    const std::unique_ptr<Stream> stream;
  };

  static ssize_t on_read(void* open, std::uint64_t, char* to, std::size_t size) {
    auto& it = *static_cast<Open*>(open);
    const Stream::Piece piece = it.stream->read({to, size});
    if (piece.what == Stream::Piece::What::End) return MHD_CONTENT_READER_END_OF_STREAM;
    if (piece.what == Stream::Piece::What::Bytes) return static_cast<ssize_t>(piece.count);
    it.server.waiting.insert(it.connection);
    mhd().suspend_connection(it.connection);
    return 0;
  }

  static void on_free(void* open) { delete static_cast<Open*>(open); }

  // -----------------------------------------------------------------------------------------------

  std::optional<WebAnswer> refuse(MHD_Connection* connection, const WebRequest& request) {
    if (auto refusal = answering.refuse(request)) return refusal;
    return refuse_body(connection);
  }

  MHD_Result answer(MHD_Connection* connection, const WebRequest& request) {
    WebAnswer it = answering.answer(request);
    if (it.stream && streams >= kMostStreams) {
      it = refusal(MHD_HTTP_SERVICE_UNAVAILABLE, {"too many watch this run"});
    }
    const bool is_endless = it.stream && it.stream->is_endless();
    deadlines[connection] = {
        .at = is_endless ? Nanoseconds::max() : monotonic_now() + kLongestAnswer, .asks = false};
    return send(connection, it);
  }

  MHD_Result send(MHD_Connection* connection, WebAnswer& answer) {
    MHD_Response* response = make_response(connection, answer);
    if (response == nullptr) throw std::bad_alloc();
    const auto add = [response](const char* name, const std::string& value) {
      mhd().add_response_header(response, name, value.c_str());
    };
    add(MHD_HTTP_HEADER_CONTENT_TYPE, std::string(answer.type));
    add("Content-Security-Policy", answer.policy + "; frame-ancestors 'none'");
    add("X-Content-Type-Options", "nosniff");
    add("Cross-Origin-Resource-Policy", "same-origin");
    add("Referrer-Policy", "no-referrer");
    add(MHD_HTTP_HEADER_CACHE_CONTROL, "no-store");
    add(MHD_HTTP_HEADER_CONNECTION, "close");
    const MHD_Result result = mhd().queue_response(connection, answer.status, response);
    mhd().destroy_response(response);
    return result;
  }

  MHD_Response* make_response(MHD_Connection* connection, WebAnswer& answer) {
    if (!answer.stream) {
      return mhd().create_response_from_buffer(answer.body.size(), answer.body.data(),
                                               MHD_RESPMEM_MUST_COPY);
    }
    auto open = std::make_unique<Open>(*this, connection, std::move(answer.stream));
    MHD_Response* response =
        mhd().create_response_from_callback(MHD_SIZE_UNKNOWN, kPiece, on_read, open.get(), on_free);
    if (response != nullptr) static_cast<void>(open.release());
    return response;
  }

  // Each byte that comes now and then keeps a connection alive for libmicrohttpd, not for us. And
  // it does not see that a client has left if the end came together with the last bytes.
  void cut_off() {
    const Nanoseconds now = monotonic_now();
    if (now < next_look) return;
    next_look = now + kBetweenLooks;
    for (const auto& [connection, deadline] : deadlines) {
      const auto* info = mhd().get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD);
      const bool has_left = deadline.asks && is_at_end(info->connect_fd);
      if (has_left || now >= deadline.at) shutdown(info->connect_fd, SHUT_RDWR);
    }
  }

  // Nothing comes any more, and everything that came has been read.
  static bool is_at_end(int socket) {
    char byte = 0;
    const ssize_t count = recv(socket, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
    return count == 0 || (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR);
  }

  struct Deadline {
    Nanoseconds at;
    bool asks;  // its request is not complete
  };

  Answering& answering;
  MHD_Daemon* daemon = nullptr;
  std::size_t streams = 0;
  std::unordered_set<MHD_Connection*> waiting;  // suspended: their stream has nothing
  std::unordered_map<MHD_Connection*, Deadline> deadlines;
  Nanoseconds next_look{0};
};

bool has_http_server() {
  return true;
}

HttpServer::HttpServer(FileDescriptor listener, Answering& answering)
    : it_(std::make_unique<Implementation>(answering)) {
  const bool listens = listener.number() >= 0;
  // It closes what it gets.
  const int socket = listens ? fcntl(listener.number(), F_DUPFD_CLOEXEC, 0) : -1;
  const unsigned flags = MHD_USE_EPOLL | MHD_ALLOW_SUSPEND_RESUME;
  MHD_OptionItem listening[] = {{MHD_OPTION_LISTEN_SOCKET, socket, nullptr},
                                {MHD_OPTION_END, 0, nullptr}};
  it_->daemon = mhd().start_daemon(
      listens ? flags : flags | MHD_USE_NO_LISTEN_SOCKET, 0, nullptr, nullptr,
      Implementation::on_request, it_.get(), MHD_OPTION_ARRAY, listens ? listening : listening + 1,
      MHD_OPTION_CONNECTION_LIMIT, kMostConnections, MHD_OPTION_CONNECTION_MEMORY_LIMIT, kMemory,
      MHD_OPTION_CONNECTION_TIMEOUT, kLongestSilence, MHD_OPTION_NOTIFY_COMPLETED,
      Implementation::on_completed, it_.get(), MHD_OPTION_NOTIFY_CONNECTION,
      Implementation::on_connection, it_.get(), MHD_OPTION_UNESCAPE_CALLBACK,
      Implementation::keep_escapes, nullptr, MHD_OPTION_STRICT_FOR_CLIENT, 1, MHD_OPTION_END);
  if (it_->daemon == nullptr) throw std::runtime_error("the server of the monitor does not start");
}

// A suspended connection would be a mistake for libmicrohttpd.
HttpServer::~HttpServer() {
  wake_streams();
  mhd().run(it_->daemon);
  wake_streams();
  mhd().stop_daemon(it_->daemon);
}

int HttpServer::descriptor() const {
  return mhd().get_daemon_info(it_->daemon, MHD_DAEMON_INFO_EPOLL_FD)->epoll_fd;
}

bool HttpServer::serve(FileDescriptor connection) {
  sockaddr address{.sa_family = AF_UNIX, .sa_data = {}};
  const int socket = fcntl(connection.number(), F_DUPFD_CLOEXEC, 0);
  return mhd().add_connection(it_->daemon, socket, &address, sizeof address.sa_family) == MHD_YES;
}

// libmicrohttpd may know of work that does not make its descriptor readable.
void HttpServer::run() {
  constexpr int kMostTurns = 64;
  it_->cut_off();
  for (int turn = 0; turn == 0 || (has_more() && turn < kMostTurns); ++turn) mhd().run(it_->daemon);
}

bool HttpServer::has_more() const {
  MHD_UNSIGNED_LONG_LONG milliseconds = 1;
  return mhd().get_timeout(it_->daemon, &milliseconds) == MHD_YES && milliseconds == 0;
}

void HttpServer::wake_streams() {
  for (MHD_Connection* connection : std::exchange(it_->waiting, {})) {
    mhd().resume_connection(connection);
  }
}

std::size_t HttpServer::streams() const {
  return it_->streams;
}

}  // namespace lockstep::host

#include "web/http_server.h"

#include <microhttpd.h>
#include <sys/socket.h>

#include <new>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <utility>

#include "core/value.h"

namespace lockstep {
namespace {

constexpr unsigned kMostConnections = 250;
constexpr std::size_t kMostHeader = 16u << 10;  // bytes that a connection may take, body included
constexpr std::size_t kMostBody = 4u << 10;
constexpr unsigned kLongestSilence = 30;   // seconds, of a client that takes nothing
constexpr std::size_t kPiece = 16u << 10;  // bytes of a stream that are read at once

std::optional<std::string> header(MHD_Connection* connection, const char* name) {
  const char* value = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, name);
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

std::optional<std::uint64_t> number(const char* text) {
  if (text == nullptr) return std::nullopt;
  const auto value = parse_int(text);
  return value && *value >= 0 ? std::optional<std::uint64_t>(*value) : std::nullopt;
}

// A request whose body is coming in.
struct Incoming {
  Request request;
};

}  // namespace

struct HttpServer::Implementation {
  explicit Implementation(Answering& all_answering) : answering(all_answering) {}

  // --- for libmicrohttpd -------------------------------------------------------------------------

  static MHD_Result on_request(void* self, MHD_Connection* connection, const char* url,
                               const char* method, const char*, const char* data, std::size_t* size,
                               void** state) {
    auto& it = *static_cast<Implementation*>(self);
    auto* incoming = static_cast<Incoming*>(*state);
    if (incoming == nullptr) {
      incoming = new Incoming{it.read_head(connection, url, method)};
      *state = incoming;
      if (it.has_body(connection)) return it.is_small(connection) ? MHD_YES : it.refuse(connection);
      return it.has_body(connection) ? MHD_YES : it.reply(connection, incoming->request);
    }
    if (*size > 0) {
      if (incoming->request.body.size() + *size > kMostBody) return MHD_NO;
      incoming->request.body.append(data, *size);
      *size = 0;
      return MHD_YES;
    }
    return it.reply(connection, incoming->request);
  }

  static void on_completed(void* self, MHD_Connection* connection, void** state,
                           MHD_RequestTerminationCode) {
    static_cast<Implementation*>(self)->waiting.erase(connection);
    delete static_cast<Incoming*>(std::exchange(*state, nullptr));
  }

  struct Open {
    Implementation& server;
    MHD_Connection* connection;
    std::unique_ptr<Stream> stream;
  };

  static ssize_t on_read(void* open, std::uint64_t, char* to, std::size_t size) {
    auto& it = *static_cast<Open*>(open);
    const Stream::Piece piece = it.stream->read({to, size});
    if (piece.what == Stream::Piece::What::End) return MHD_CONTENT_READER_END_OF_STREAM;
    if (piece.what == Stream::Piece::What::Bytes) return static_cast<ssize_t>(piece.count);
    it.server.waiting.insert(it.connection);
    MHD_suspend_connection(it.connection);
    return 0;
  }

  static void on_free(void* open) { delete static_cast<Open*>(open); }

  // -----------------------------------------------------------------------------------------------

  Request read_head(MHD_Connection* connection, const char* url, const char* method) const {
    return {
        .method = method,
        .path = url,
        .host = header(connection, MHD_HTTP_HEADER_HOST),
        .origin = header(connection, "Origin"),
        .token = header(connection, "X-Lockstep-Token"),
        .after = number(MHD_lookup_connection_value(connection, MHD_GET_ARGUMENT_KIND, "after"))};
  }

  bool has_body(MHD_Connection* connection) const {
    return header(connection, MHD_HTTP_HEADER_TRANSFER_ENCODING) ||
           header(connection, MHD_HTTP_HEADER_CONTENT_LENGTH);
  }

  bool is_small(MHD_Connection* connection) const {
    if (header(connection, MHD_HTTP_HEADER_TRANSFER_ENCODING)) return false;
    const auto length = number(header(connection, MHD_HTTP_HEADER_CONTENT_LENGTH)->c_str());
    return length && *length <= kMostBody;
  }

  MHD_Result refuse(MHD_Connection* connection) {
    return send(connection, {.status = MHD_HTTP_CONTENT_TOO_LARGE, .body = "too large\n"});
  }

  MHD_Result reply(MHD_Connection* connection, const Request& request) {
    return send(connection, answering.answer(request));
  }

  MHD_Result send(MHD_Connection* connection, Answer answer) {
    MHD_Response* response =
        answer.stream ? MHD_create_response_from_callback(
                            MHD_SIZE_UNKNOWN, kPiece, on_read,
                            new Open{*this, connection, std::move(answer.stream)}, on_free)
                      : MHD_create_response_from_buffer(answer.body.size(), answer.body.data(),
                                                        MHD_RESPMEM_MUST_COPY);
    if (response == nullptr) throw std::bad_alloc();
    const auto add = [response](const char* name, const std::string& value) {
      MHD_add_response_header(response, name, value.c_str());
    };
    add(MHD_HTTP_HEADER_CONTENT_TYPE, std::string(answer.type));
    add(MHD_HTTP_HEADER_CONNECTION, "close");
    add(MHD_HTTP_HEADER_CACHE_CONTROL, "no-store");
    const MHD_Result result = MHD_queue_response(connection, answer.status, response);
    MHD_destroy_response(response);
    return result;
  }

  Answering& answering;
  MHD_Daemon* daemon = nullptr;
  std::unordered_set<MHD_Connection*> waiting;  // suspended: their stream has nothing
};

bool has_http_server() {
  return true;
}

HttpServer::HttpServer(FileDescriptor listener, Answering& answering)
    : it_(std::make_unique<Implementation>(answering)) {
  const int socket = dup(listener.number());
  it_->daemon = MHD_start_daemon(
      MHD_USE_EPOLL | MHD_ALLOW_SUSPEND_RESUME, 0, nullptr, nullptr, Implementation::on_request,
      it_.get(), MHD_OPTION_LISTEN_SOCKET, socket, MHD_OPTION_CONNECTION_LIMIT, kMostConnections,
      MHD_OPTION_CONNECTION_MEMORY_LIMIT, kMostHeader, MHD_OPTION_CONNECTION_TIMEOUT,
      kLongestSilence, MHD_OPTION_NOTIFY_COMPLETED, Implementation::on_completed, it_.get(),
      MHD_OPTION_END);
  if (it_->daemon == nullptr) throw std::runtime_error("the monitor's server does not start");
}

HttpServer::~HttpServer() {
  wake_streams();
  MHD_run(it_->daemon);
  MHD_stop_daemon(it_->daemon);
}

int HttpServer::descriptor() const {
  return MHD_get_daemon_info(it_->daemon, MHD_DAEMON_INFO_EPOLL_FD)->epoll_fd;
}

void HttpServer::run() {
  MHD_run(it_->daemon);
}

void HttpServer::wake_streams() {
  for (MHD_Connection* connection : std::exchange(it_->waiting, {})) {
    MHD_resume_connection(connection);
  }
}

std::size_t HttpServer::clients() const {
  return MHD_get_daemon_info(it_->daemon, MHD_DAEMON_INFO_CURRENT_CONNECTIONS)->num_connections;
}

}  // namespace lockstep

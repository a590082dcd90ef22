// In place of http_server.cpp, where libmicrohttpd is not there.
#include "show/web/http_server.h"

namespace lockstep::host {

struct HttpServer::Implementation {};

bool has_http_server() {
  return false;
}

HttpServer::HttpServer(FileDescriptor, Answering&) {}
HttpServer::~HttpServer() = default;
int HttpServer::descriptor() const {
  return -1;
}
bool HttpServer::serve(FileDescriptor) {
  return false;
}
void HttpServer::run() {}
bool HttpServer::has_more() const {
  return false;
}
void HttpServer::wake_streams() {}
std::size_t HttpServer::streams() const {
  return 0;
}

}  // namespace lockstep::host

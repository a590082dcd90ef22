// Speaks HTTP with the clients of the monitor. One request a connection; whoever is slow, large or
// silent is cut off. All on the thread that calls run(). The only file that knows libmicrohttpd.
#pragma once

#include <memory>

#include "base/system/file_descriptor.h"
#include "show/web/answer.h"

namespace lockstep::host {

// False: lockstep was built without libmicrohttpd.
bool has_http_server();

class HttpServer {
 public:
  // Without a listener, only serve() brings clients.
  HttpServer(FileDescriptor listener, Answering& answering);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  // Can be read when run() has something to do.
  int descriptor() const;
  // A client that is connected already. False: it was refused.
  bool serve(FileDescriptor connection);
  // Serves what can be served without waiting.
  void run();
  // run() has something to do at once; else when the descriptor can be read.
  bool has_more() const;
  // Streams that wait may have more.
  void wake_streams();
  // Streams that have not ended.
  std::size_t streams() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> it_;
};

}  // namespace lockstep::host

// Serves one page to the browsers of this machine until it is stopped: a recording that is looked
// at, without a run.
#pragma once

#include <functional>
#include <string>

#include "show/web/answer.h"
#include "show/web/gate.h"
#include "show/web/http_server.h"
#include "show/web/server_socket.h"

namespace lockstep::host {

class PageServer final : private Answering {
 public:
  // Only this machine can reach the socket, so nobody is asked for a token.
  PageServer(std::string page, ServerSocket socket);

  std::string link() const { return "http://" + address_ + "/"; }
  // Returns when `stop` is true, which is asked after each signal and now and then.
  void serve_until(const std::function<bool()>& stop);

 private:
  std::optional<WebAnswer> refuse(const WebRequest& head) override;
  WebAnswer answer(const WebRequest& request) override;

  const std::string page_;
  const Gate gate_;
  const std::string address_;
  HttpServer server_;
};

}  // namespace lockstep::host

#include "show/web/page_server.h"

#include <poll.h>

#include <utility>

#include "show/web/page.h"

namespace lockstep::host {

PageServer::PageServer(std::string page, ServerSocket socket)
    : page_(std::move(page)),
      gate_(std::move(socket.name), {}),
      address_(std::move(socket.address)),
      server_(std::move(socket.socket), *this) {}

void PageServer::serve_until(const std::function<bool()>& stop) {
  constexpr int kLook = 100;  // ms
  while (!stop()) {
    server_.run();
    pollfd file{server_.descriptor(), POLLIN, 0};
    poll(&file, 1, server_.has_more() ? 0 : kLook);
  }
}

std::optional<WebAnswer> PageServer::refuse(const WebRequest& head) {
  return gate_.refuse(head);
}

WebAnswer PageServer::answer(const WebRequest& request) {
  if (request.path != "/") return refusal(404, {"there is no such page"});
  if (request.method != "GET") return refusal(405, {"only GET"});
  return {.type = "text/html; charset=utf-8", .body = page_, .policy = std::string(page_policy())};
}

}  // namespace lockstep::host

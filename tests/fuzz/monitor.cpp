// Any bytes as what clients of the monitor send: they get an answer or none, in bounded time and
// memory, and without the token neither the run nor control over it. The first byte says where the
// bytes are cut in two that come one after the other.
#include <sys/socket.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "record/live/orders.h"
#include "require.h"
#include "run/run_control.h"
#include "run/shape_of.h"
#include "show/web/gate.h"
#include "show/web/http_server.h"
#include "support/compiled.h"

namespace fuzz_monitor_target {
namespace {

using namespace lockstep::host;
using fuzz::require;

constexpr std::string_view kToken = "TOKEN";

// A Wait with an entry, under a Sequence.
Tree small_tree() {
  return test::compiled(
      "<root lockstep=\"1\"><BehaviorTree ID=\"B\"><Sequence><Wait seconds=\"{pause}\"/></Sequence>"
      "</BehaviorTree></root>");
}

// What the monitor answers, with the run left out.
class Answers final : public Answering {
 public:
  std::optional<WebAnswer> refuse(const WebRequest& head) override { return gate_.refuse(head); }
  WebAnswer answer(const WebRequest& request) override {
    const bool has_token = request.token == kToken;
    const bool is_page = request.path == "/" && request.method == "GET";
    require(has_token || is_page);
    require(request.host.has_value() && request.body.size() <= 4096);
    if (request.method == "POST") {
      const auto order = read_order(shape_, request.path == "/wall", request.body);
      if (!order) return {.status = 400, .body = order.error().message};
      require(order->breakpoint.node < shape_.nodes.size());
      return {.status = 204};
    }
    return {.status = 200, .body = request.path};
  }

 private:
  const Tree tree_ = small_tree();
  const Shape shape_ = shape_of(tree_);
  const Gate gate_{"robot", std::string(kToken)};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Answers answers;
  static HttpServer server(FileDescriptor{}, answers);
  if (size == 0 || size > 64u << 10) return 0;
  int ends[2];
  require(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends) == 0);
  const FileDescriptor client(ends[0]);
  require(server.serve(FileDescriptor(ends[1])));
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::size_t cut = bytes.size() * data[0] / 256;
  for (const std::string_view part : {bytes.substr(0, cut), bytes.substr(cut)}) {
    [[maybe_unused]] const ssize_t sent =
        send(client.number(), part.data(), part.size(), MSG_NOSIGNAL);
    server.run();
  }
  shutdown(client.number(), SHUT_WR);
  std::string answer(128u << 10, '\0');
  std::size_t length = 0;
  constexpr int kMost = 1000;
  for (int i = 0; i < kMost; ++i) {
    server.run();
    const ssize_t count = recv(client.number(), answer.data() + length, answer.size() - length, 0);
    if (count == 0) break;
    if (count > 0) length += static_cast<std::size_t>(count);
    require(i + 1 < kMost && length < answer.size());
  }
  require(length == 0 || answer.starts_with("HTTP/1.1 ") || answer.starts_with("HTTP/1.0 "));
  return 0;
}

}  // namespace fuzz_monitor_target

// What somebody may try with the monitor: docs/security.md, row by row.
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <set>
#include <sstream>

#include "support/json.h"
#include "web/client.h"

using namespace lockstep::host::test;

namespace {

// A run of this tree that never ends, with a token.
class Guarded {
 public:
  explicit Guarded(const std::vector<std::string>& more = {"--monitor-control"})
      : run_(with(
            directory_.file("tree.xml", tree_text("<Advance name=\"arm &lt;b&gt;\" step=\"0\"/>")),
            more)) {}

  unsigned port() const { return run_.port(); }
  std::string token() const { return "X-Lockstep-Token: " + run_.token() + "\r\n"; }
  MonitoredRun& run() { return run_; }

  // Of a request with these headers and no others.
  int status_of(const std::string& request) const {
    Client client(port());
    client.send(request);
    return split_response(client.finish()).status;
  }

  // Others are served meanwhile, and the program stays small. It ends in order.
  void check_is_well() {
    CHECK(get(port(), "/").status == 200);
    Client events(port());
    events.send(get_text(port(), "/events", token()));
    CHECK(events.wait_for("data: {\"tick\":"));
    const Outcome outcome = run_.process().end_by(SIGTERM);
    CHECK(outcome.code == 143);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    CHECK(outcome.peak_megabytes < 20 + kAlone);
#endif
  }

 private:
  // Of the program without a monitor, with the page in it and its libraries.
  static constexpr double kAlone = 12;

  static std::vector<std::string> with(const std::string& tree,
                                       const std::vector<std::string>& more) {
    std::vector<std::string> all{tree, "--monitor", "--view", "none"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  TemporaryDirectory directory_;
  MonitoredRun run_;
};

std::set<std::string> sockets_of(const std::string& process) {
  std::set<std::string> sockets;
  for (const auto& file : std::filesystem::directory_iterator("/proc/" + process + "/fd")) {
    std::error_code error;
    const std::string target = std::filesystem::read_symlink(file.path(), error);
    if (target.starts_with("socket:")) sockets.insert(target);
  }
  return sockets;
}

std::string host(const std::string& name) {
  return "GET / HTTP/1.1\r\nHost: " + name + "\r\n\r\n";
}

}  // namespace

TEST_CASE("without its token the monitor gives nothing but the empty page") {
  Guarded it;
  for (const char* path : {"/events", "/history", "/control", "/nothing"}) {
    CAPTURE(path);
    CHECK(get(it.port(), path).status == 403);
    CHECK(get(it.port(), path, "X-Lockstep-Token: 1\r\n").status == 403);
    std::string other = it.token();
    other[other.size() - 3] ^= 1;
    CHECK(get(it.port(), path, other).status == 403);
  }
  CHECK(post(it.port(), "/control", "{\"do\":\"halt\"}").status == 403);
  CHECK(get(it.port(), "/").status == 200);
  CHECK_FALSE(contains(get(it.port(), "/").body, it.run().token()));
  CHECK(it.run().token().size() == 32);
  CHECK(get(it.port(), "/history", it.token()).status == 200);
  it.check_is_well();
}

TEST_CASE("a monitor that others can reach has a token") {
  Guarded it({"--monitor-control"});
  Guarded other({"--monitor-control"});
  CHECK(it.run().token() != other.run().token());
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text("<Advance step=\"0\"/>"));
  MonitoredRun open({tree, "--monitor=0.0.0.0:0"});
  CHECK(open.token().size() == 32);
  CHECK(get(open.port(), "/events").status == 403);
  MonitoredRun closed({tree, "--monitor"});
  CHECK(closed.token().empty());
  CHECK(post(closed.port(), "/control", "{\"do\":\"halt\"}").status == 403);
}

TEST_CASE("a name that leads here is not enough") {
  Guarded it;
  for (const char* name : {"evil.example", "evil.example:80", "127.0.0.1.evil.example",
                           "localhost.", "[::1", "", "127.0.0.1:80@evil.example"}) {
    CAPTURE(name);
    CHECK(it.status_of(host(name)) == 421);
  }
  for (const char* name : {"localhost", "localhost:1", "127.0.0.1", "[::1]:7", "10.0.0.5:80"}) {
    CAPTURE(name);
    CHECK(it.status_of(host(name)) == 200);
  }
  CHECK(it.status_of("GET / HTTP/1.1\r\n\r\n") >= 400);
  CHECK(it.status_of("GET / HTTP/1.0\r\n\r\n") == 421);
}

TEST_CASE("each refusal is JSON, with its error") {
  Guarded it;
  const auto error_of = [](const Response& response) {
    CHECK(contains(response.head, "Content-Type: application/json"));
    return response.status >= 400 ? parse_json(response.body)["error"].get<std::string>() : "";
  };
  const unsigned port = it.port();
  CHECK(error_of(post(port, "/control", R"({"do":"halt"})")) == "the token is missing or wrong");
  CHECK(error_of(post(port, "/control", R"({"do":"halt"})",
                      "Origin: http://evil.example\r\n" + it.token())) ==
        "pages of other hosts are rejected");
  CHECK(error_of(post(port, "/control", std::string(4097, ' '), it.token())) ==
        "the body is too large");
  CHECK_FALSE(error_of(post(port, "/control", "?", it.token())).empty());
  CHECK(error_of(get(port, "/control", it.token())) == "only POST");
  CHECK(error_of(get(port, "/nothing", it.token())) == "there is no such page");
}

TEST_CASE("pages of other sites may not ask, and may not look at the answer") {
  Guarded it;
  const std::string port = std::to_string(it.port());
  CHECK(get(it.port(), "/", "Origin: http://127.0.0.1:" + port + "\r\n").status == 200);
  for (const char* origin :
       {"http://evil.example", "null", "https://127.0.0.1", "http://127.0.0.1"}) {
    const std::string header = std::string("Origin: ") + origin + "\r\n";
    CHECK(get(it.port(), "/", header).status == 403);
    CHECK(post(it.port(), "/control", "{\"do\":\"halt\"}", header + it.token()).status == 403);
  }
  const Response asked = get(it.port(), "/history", it.token());
  CHECK_FALSE(contains(asked.head, "Access-Control"));
  Client preflight(it.port());
  preflight.send(
      "OPTIONS /control HTTP/1.1\r\nHost: localhost\r\nOrigin: http://evil.example\r\n\r\n");
  CHECK(split_response(preflight.finish()).status == 403);
}

TEST_CASE("the page may load nothing from elsewhere, and is in no frame") {
  Guarded it;
  const Response page = get(it.port(), "/");
  CHECK(contains(page.head, "Content-Security-Policy: default-src 'none'; "));
  CHECK(contains(page.head, "; frame-ancestors 'none'\r\n"));
  CHECK_FALSE(contains(page.head, "unsafe"));
  CHECK(contains(page.head, "X-Content-Type-Options: nosniff\r\n"));
  CHECK(contains(page.head, "Cross-Origin-Resource-Policy: same-origin\r\n"));
  CHECK(contains(page.head, "Referrer-Policy: no-referrer\r\n"));
  CHECK_FALSE(contains(page.body, "src=\"http"));
  // What a tree calls its nodes is not in it.
  CHECK_FALSE(contains(page.body, "arm <b>"));
  const Response lines = get(it.port(), "/history", it.token());
  CHECK(contains(lines.head,
                 "Content-Security-Policy: default-src 'none'; frame-ancestors 'none'\r\n"));
}

TEST_CASE("no path leads to a file") {
  Guarded it;
  for (const char* path : {"/../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd",
                           "/events/../../x", "/history%00.html", "/tree.xml"}) {
    CAPTURE(path);
    CHECK(get(it.port(), path, it.token()).status >= 400);
  }
}

TEST_CASE("a header of fifty megabytes is refused") {
  Guarded it;
  const std::string megabyte(1 << 20, 'x');
  for (const char* begin :
       {"GET / HTTP/1.1\r\nHost: localhost\r\nX-Long: ", "GET /", "GET / HTTP/1.1\r\n"}) {
    Client client(it.port());
    bool is_open = client.send(begin);
    for (int i = 0; i < 50 && is_open; ++i) is_open = client.send(megabyte);
    CHECK_FALSE(is_open);
  }
  Client many(it.port());
  bool is_open = many.send("GET / HTTP/1.1\r\nHost: localhost\r\n");
  for (int i = 0; i < 100'000 && is_open; ++i)
    is_open = many.send("X-" + std::to_string(i) + ": 1\r\n");
  CHECK_FALSE(is_open);
  it.check_is_well();
}

TEST_CASE("a body that is large, or does not tell its length, is not read") {
  Guarded it;
  const std::string head = "POST /control HTTP/1.1\r\nHost: localhost\r\n" + it.token();
  CHECK(it.status_of(head + "Content-Length: 52428800\r\n\r\n") == 413);
  CHECK(it.status_of(head + "Content-Length: 99999999999999999999\r\n\r\n") >= 400);
  CHECK(it.status_of(head + "Content-Length: -1\r\n\r\n") >= 400);
  CHECK(it.status_of(head + "Transfer-Encoding: chunked\r\n\r\n") == 411);
  const std::string chunk = "10000\r\n" + std::string(0x10000, 'x') + "\r\n";
  Client endless(it.port());
  bool is_open = endless.send(head + "Transfer-Encoding: chunked\r\n\r\n");
  for (int i = 0; i < 1000 && is_open; ++i) is_open = endless.send(chunk);
  CHECK_FALSE(is_open);
  CHECK(post(it.port(), "/control", std::string(4096, ' '), it.token()).status == 400);
  CHECK(post(it.port(), "/control", std::string(4097, ' '), it.token()).status == 413);
  it.check_is_well();
}

TEST_CASE("who asks byte by byte is cut off, and so is who asks half") {
  Guarded it;
  Client slow(it.port()), silent(it.port()), half(it.port());
  half.send("POST /control HTTP/1.1\r\nHost: localhost\r\n" + it.token() +
            "Content-Length: 10\r\n\r\n{");
  // A letter whenever the run has another line.
  Client events(it.port());
  events.send(get_text(it.port(), "/events", it.token()));
  std::size_t read = 0;
  slow.send("GET / HTTP/1.1\r\nX: ");
  while (slow.send("x")) {
    REQUIRE(events.wait_for("\ndata: ", read));
    read = events.so_far().size();
  }
  CHECK(half.finish().empty());
  CHECK(silent.finish().empty());
  it.check_is_well();
}

TEST_CASE("a hundred that never read and a hundred that never ask do not keep others out") {
  Guarded it;
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 100; ++i) {
    clients.push_back(std::make_unique<Client>(it.port()));
    clients.back()->send(get_text(it.port(), "/events", it.token()));
    clients.push_back(std::make_unique<Client>(it.port()));
    clients.back()->send("GET / HTTP/1.1\r\nHost: ");
  }
  it.check_is_well();
}

TEST_CASE("a thousand that have asked half and left do not keep others out") {
  Guarded it;
  constexpr std::chrono::seconds kLongestRequest{10};
  for (int i = 0; i < 1000; ++i) Client(it.port()).send("GET");
  const auto begin = std::chrono::steady_clock::now();
  CHECK(get(it.port(), "/").status == 200);
  CHECK(std::chrono::steady_clock::now() - begin < kLongestRequest);
  it.check_is_well();
}

TEST_CASE("who says that nothing more comes gets an answer to what was asked") {
  Guarded it;
  Client client(it.port());
  client.send(get_text(it.port(), "/"));
  client.send_end();
  CHECK(split_response(client.finish()).status == 200);
}

TEST_CASE("more than can be served watch: those that are too many are told, others are served") {
  Guarded it;
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 151; ++i) {
    clients.push_back(std::make_unique<Client>(it.port()));
    clients.back()->send(get_text(it.port(), "/events", it.token()));
    REQUIRE(clients.back()->wait_for("\r\n\r\n"));
  }
  CHECK(split_response(clients.front()->so_far()).status == 200);
  CHECK(split_response(clients.back()->finish()).status == 503);
  CHECK(get(it.port(), "/").status == 200);
}

TEST_CASE("garbage is no request") {
  Guarded it;
  std::vector<std::unique_ptr<Client>> clients;
  for (const std::string& bytes :
       {std::string("\r\n\r\n\r\n"), std::string("GET\r\n\r\n"), std::string(1000, '\0'),
        std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11) + "\r\n\r\n",
        std::string("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"),
        std::string("GET / HTTP/9.9\r\nHost: localhost\r\n\r\n")}) {
    clients.push_back(std::make_unique<Client>(it.port()));
    clients.back()->send(bytes);
  }
  for (const auto& client : clients) {
    const int status = split_response(client->finish()).status;
    CHECK((status == 0 || status >= 400));
  }
  it.check_is_well();
}

TEST_CASE("no program that lockstep starts gets a socket of the monitor") {
  Guarded it({"--monitor-control", "--isolate"});
  Client events(it.port());
  events.send(get_text(it.port(), "/events", it.token()));
  REQUIRE(events.wait_for("data: {\"tick\":"));
  const std::string process = std::to_string(it.run().process().id());
  const auto sockets = sockets_of(process);
  CHECK(sockets.size() >= 2);  // one listens, one is ours
  std::istringstream children(read_file("/proc/" + process + "/task/" + process + "/children"));
  std::string child;
  REQUIRE(children >> child);
  do {
    for (const std::string& socket : sockets_of(child)) CHECK_FALSE(sockets.contains(socket));
  } while (children >> child);
}

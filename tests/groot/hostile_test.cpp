// Clients that are none of Groot2: the run goes on, and its memory stays small.
#include <catch2/catch.hpp>

#include "groot/groot_run.h"
#include "web/client.h"

using namespace lockstep::host::test;
using nlohmann::json;

namespace {

[[maybe_unused]] constexpr double kMegabytes = 80;

const std::string kWait = tree_text("<Wait seconds=\"0.02\"/>");

std::string text(std::initializer_list<int> bytes) {
  return {bytes.begin(), bytes.end()};
}

// The head of a long frame; `flags`: 2, and 1 if more follow.
std::string frame_head(int flags, std::uint64_t size) {
  std::string head = text({flags});
  for (int byte = 7; byte >= 0; --byte) head += static_cast<char>(size >> (8 * byte));
  return head;
}

// A connection that has said what it is, as ZeroMQ does, and nothing more.
struct Peer : Client {
  Peer(unsigned port, const std::string& type) : Client(port) {
    const std::string name = text({5}) + "READY" + text({11}) + "Socket-Type" +
                             text({0, 0, 0, static_cast<int>(type.size())}) + type;
    send(text({0xff, 0, 0, 0, 0, 0, 0, 0, 0, 0x7f, 3, 0}) + "NULL" + std::string(16 + 32, '\0') +
         text({4, static_cast<int>(name.size())}) + name);
    REQUIRE(wait_for("READY"));
  }
  // As long as the other side takes it, `most` megabytes.
  void flood(const std::string& bytes, int most) {
    for (std::size_t sent = 0; sent < static_cast<std::size_t>(most) << 20; sent += bytes.size()) {
      if (!send(bytes)) return;
    }
    FAIL("it took all");
  }
};

void goes_on(GrootRun& it) {
  CHECK(it.ask("S")["value"] == json{{1, 0}});
  const Outcome outcome = it.resume();
  CHECK(outcome.code == 0);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  CHECK(outcome.peak_megabytes < kMegabytes);
#endif
}

}  // namespace

TEST_CASE("a part of a message that is too large closes the connection") {
  GrootRun it(kWait);
  Peer peer(it.port(), "REQ");
  peer.send(text({1, 0}));
  peer.flood(frame_head(2, 100u << 20) + std::string(1u << 20, 'x'), 100);
  goes_on(it);
}

TEST_CASE("a message without an end closes the connection") {
  GrootRun it(kWait);
  Peer peer(it.port(), "REQ");
  peer.send(text({1, 0}));
  peer.flood(frame_head(3, 60'000) + std::string(60'000, 'x'), 1000);
  goes_on(it);
}

TEST_CASE("connections beyond the first ones are closed") {
  GrootRun it(kWait);
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 100; ++i) clients.push_back(std::make_unique<Client>(it.port()));
  for (int i = 64; i < 100; ++i) clients[static_cast<std::size_t>(i)]->finish();
  clients.clear();
  goes_on(it);
}

TEST_CASE("a client that says nothing is closed") {
  GrootRun it(kWait);
  Client silent(it.port());
  silent.finish();
  goes_on(it);
}

TEST_CASE("clients that send nothing sensible, or read nothing, cost little") {
  GrootRun it(kWait);
  Client browser(it.port());
  browser.send("GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
  Peer unread(it.port(), "DEALER");
  std::string asked;
  for (int i = 0; i < 5000; ++i) asked += text({1, 0, 0, 6, 2, 'T', 0, 0, 0, 0});
  unread.send(asked);
  Peer listener(it.port() + 1, "SUB");
  std::string wishes;
  for (int i = 0; i < 5000; ++i) wishes += text({0, 5, 1, i, i >> 8, 0, 0});
  listener.send(wishes);
  goes_on(it);
}

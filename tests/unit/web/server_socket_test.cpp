// Addresses on which the monitor is reached.
#include "show/web/server_socket.h"

#include <catch2/catch.hpp>

namespace lockstep::host {

TEST_CASE("an address that was looked up has numbers, and keeps its name") {
  CHECK(resolve("127.0.0.1:8080").value() == "127.0.0.1:8080 127.0.0.1");
  CHECK(resolve("[::1]:8080").value() == "[::1]:8080 ::1");
  const std::string local = resolve("localhost:0").value();
  CHECK(local.ends_with(":0 localhost"));
  CHECK_FALSE(local.starts_with("localhost"));
}

TEST_CASE("who must not wait for a name server takes no name") {
  const auto listener = listen_on_resolved("127.0.0.1:0 robot");
  REQUIRE(listener);
  CHECK(listener->name == "robot");
  CHECK(listener->address.starts_with("127.0.0.1:"));
  CHECK_FALSE(listen_on_resolved("localhost:0"));
  CHECK_FALSE(listen_on_resolved("localhost:0 localhost"));
}

}  // namespace lockstep::host

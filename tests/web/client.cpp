#include "web/client.h"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>

namespace lockstep::host::test {
namespace {

constexpr int kPatience = 60'000;  // milliseconds

}  // namespace

Client::Client(unsigned port) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  REQUIRE(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
}

Client::~Client() {
  close(socket_);
}

bool Client::send(const std::string& bytes) {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t count = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) return false;
    sent += static_cast<std::size_t>(count);
  }
  return true;
}

void Client::send_end() {
  shutdown(socket_, SHUT_WR);
}

bool Client::read_more() {
  pollfd file{socket_, POLLIN, 0};
  REQUIRE(poll(&file, 1, kPatience) > 0);
  char buffer[65536];
  const ssize_t count = recv(socket_, buffer, sizeof buffer, 0);
  if (count <= 0) return false;
  received_.append(buffer, static_cast<std::size_t>(count));
  return true;
}

bool Client::wait_for(const std::string& text, std::size_t from) {
  while (received_.find(text, from) == std::string::npos) {
    if (!read_more()) return false;
  }
  return true;
}

const std::string& Client::finish() {
  while (read_more()) {
  }
  return received_;
}

Response split_response(const std::string& text) {
  const auto end = text.find("\r\n\r\n");
  if (end == std::string::npos || !text.starts_with("HTTP/1.1 ")) return {};
  return {.status = std::stoi(text.substr(9, 3)),
          .head = text.substr(0, end + 2),
          .body = text.substr(end + 4)};
}

std::string get_text(unsigned port, const std::string& path, const std::string& headers) {
  return "GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n" + headers +
         "\r\n";
}

Response get(unsigned port, const std::string& path, const std::string& headers) {
  Client client(port);
  client.send(get_text(port, path, headers));
  return split_response(client.finish());
}

Response post(unsigned port, const std::string& path, const std::string& body,
              const std::string& headers) {
  Client client(port);
  client.send("POST " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
              "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n" + headers + "\r\n" +
              body);
  return split_response(client.finish());
}

namespace {

std::vector<std::string> as_run(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "run");
  const auto is_monitor = [](const std::string& it) {
    return it == "--monitor" || it.starts_with("--monitor=");
  };
  if (std::none_of(arguments.begin(), arguments.end(), is_monitor))
    arguments.push_back("--monitor");
  return arguments;
}

}  // namespace

MonitoredRun::MonitoredRun(std::vector<std::string> arguments)
    : process_({.arguments = as_run(std::move(arguments))}) {
  REQUIRE(process_.wait_for("monitor: http://"));
  const std::string& said = process_.so_far().err;
  while (said.find('\n', said.find("monitor: http://")) == std::string::npos) {
    REQUIRE(process_.read_on());
  }
  const auto link = said.find("monitor: http://");
  const std::string text = said.substr(link, said.find('\n', link) - link);
  port_ = static_cast<unsigned>(std::stoi(text.substr(text.rfind(':', text.find('#')) + 1)));
  if (const auto token = text.find("#token="); token != std::string::npos) {
    token_ = text.substr(token + 7);
  }
}

}  // namespace lockstep::host::test

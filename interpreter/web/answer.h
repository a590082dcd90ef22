// What a client asks of the monitor and what it gets, whatever brings it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lockstep {

struct WebRequest {
  std::string method, path;
  std::optional<std::string> host, origin, token;  // headers
  std::optional<std::uint64_t> after;              // of the query
  std::string body = {};
};

// The content of an answer that comes in pieces.
class WebStream {
 public:
  virtual ~WebStream() = default;
  // It goes on until the client leaves.
  virtual bool is_endless() const = 0;
  struct Piece {
    enum class What { Bytes, Wait, End };
    What what;
    std::size_t count = 0;
  };
  // Wait: there is nothing now, and the server asks again when there may be more.
  virtual Piece read(std::span<char> to) = 0;
};

struct WebAnswer {
  unsigned status = 200;
  std::string_view type = "text/plain; charset=utf-8";
  std::string body = {};
  std::unique_ptr<WebStream> stream = {};     // instead of `body`
  std::string policy = "default-src 'none'";  // what a page may load: Content-Security-Policy
};

class Answering {
 public:
  virtual ~Answering() = default;
  // Before the body is read: the refusal, or nothing.
  virtual std::optional<WebAnswer> refuse(const WebRequest& head) = 0;
  virtual WebAnswer answer(const WebRequest& request) = 0;
};

}  // namespace lockstep

// The requests of a client of the monitor and the answers, whatever brings them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/core/problem.h"
#include "record/live/stream.h"

namespace lockstep::host {

struct WebRequest {
  std::string method, path;
  std::optional<std::string> host, origin, token;  // headers
  std::optional<std::uint64_t> after;              // of the query
  std::string body = {};
};

struct WebAnswer {
  unsigned status = 200;
  std::string_view type = "text/plain; charset=utf-8";
  std::string body = {};
  std::unique_ptr<Stream> stream = {};        // instead of `body`
  std::string policy = "default-src 'none'";  // what a page may load: Content-Security-Policy
};

// What is answered to a request that is not granted: {"error": "...", "hint": "..."}, without an
// empty hint.
WebAnswer refusal(unsigned status, const Problem& problem);

class Answering {
 public:
  virtual ~Answering() = default;
  // Before the body is read: the refusal, or nothing.
  virtual std::optional<WebAnswer> refuse(const WebRequest& head) = 0;
  virtual WebAnswer answer(const WebRequest& request) = 0;
};

}  // namespace lockstep::host

// The base protocol of language servers: "Content-Length: 12", an empty line, and so many bytes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/core/problem.h"

namespace lockstep::host {

class FrameReader {
 public:
  static constexpr std::size_t kMaxBytes = std::size_t{512} << 20u;  // of one message
  static constexpr std::size_t kMaxHeader = 4096;

  void add(std::string_view bytes) { bytes_ += bytes; }
  // The next message, if all of it has come. After a problem nobody knows where the next begins.
  Result<std::optional<std::string>> next();

 private:
  Result<std::size_t> read_length(std::string_view header) const;

  std::string bytes_;
  std::size_t begin_ = 0;  // of what is not taken yet
};

// With the header before it.
std::string framed(std::string_view message);

}  // namespace lockstep::host

// Where a message of JSON-RPC ends. The base protocol of language servers: "Content-Length: 12", an
// empty line, and so many bytes. The Model Context Protocol: a message in each line.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/core/problem.h"

namespace lockstep::host {

enum class Framing : bool { Headers, Lines };

class FrameReader {
 public:
  explicit FrameReader(Framing framing) : framing_(framing) {}

  static constexpr std::size_t kMaxBytes = std::size_t{512} << 20u;  // of one message
  static constexpr std::size_t kMaxHeader = 4096;

  void add(std::string_view bytes) { bytes_ += bytes; }
  // The next message, if all of it has come. After a problem nobody knows where the next begins.
  Result<std::optional<std::string>> next();

 private:
  Result<std::optional<std::string>> next_line();
  Result<std::optional<std::string>> next_with_header();
  void drop(std::size_t bytes);
  Result<std::size_t> read_length(std::string_view header) const;

  const Framing framing_;
  std::string bytes_;
  std::size_t begin_ = 0;    // of what is not taken yet
  std::size_t scanned_ = 0;  // in what is not taken: no line ends before
};

// With its header, or its line end.
std::string framed(std::string_view message, Framing framing);

}  // namespace lockstep::host

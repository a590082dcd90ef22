#include "author/server/protocol/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/core/diagnostics.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kEndOfHeader = "\r\n\r\n";

bool is_same_word(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return (x | 0x20) == (y | 0x20); });
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

Result<std::optional<std::string>> FrameReader::next() {
  return framing_ == Framing::Lines ? next_line() : next_with_header();
}

void FrameReader::drop(std::size_t bytes) {
  begin_ += bytes;
  scanned_ = 0;
  if (begin_ == bytes_.size()) {
    bytes_.clear();
    begin_ = 0;
  } else if (begin_ > bytes_.size() / 2) {
    bytes_.erase(0, begin_);
    begin_ = 0;
  }
}

Result<std::optional<std::string>> FrameReader::next_line() {
  while (true) {
    const std::string_view rest = std::string_view(bytes_).substr(begin_);
    const auto end = rest.find('\n', scanned_);
    scanned_ = rest.size();
    if (end == rest.npos) {
      if (rest.size() <= kMaxBytes) return std::nullopt;
      return problem(fmt::format("a message has more than {} bytes", kMaxBytes));
    }
    std::string line(trimmed(rest.substr(0, end)));
    drop(end + 1);
    if (line.ends_with('\r')) line.pop_back();
    if (!line.empty()) return line;
  }
}

Result<std::optional<std::string>> FrameReader::next_with_header() {
  const std::string_view rest = std::string_view(bytes_).substr(begin_);
  const auto end = rest.substr(0, kMaxHeader).find(kEndOfHeader);
  if (end == rest.npos) {
    if (rest.size() < kMaxHeader) return std::nullopt;
    return problem("a message has no header that ends");
  }
  const auto length = read_length(rest.substr(0, end));
  if (!length) return tl::unexpected(length.error());
  const std::size_t whole = end + kEndOfHeader.size() + *length;
  if (rest.size() < whole) return std::nullopt;
  std::string message(rest.substr(whole - *length, *length));
  drop(whole);
  return message;
}

Result<std::size_t> FrameReader::read_length(std::string_view header) const {
  std::optional<std::size_t> length;
  while (!header.empty()) {
    const auto end = std::min(header.find("\r\n"), header.size());
    const std::string_view line = header.substr(0, end);
    header.remove_prefix(std::min(end + 2, header.size()));
    const auto colon = line.find(':');
    if (colon == line.npos)
      return problem(fmt::format("'{}' is not a header of a message", brief(printable(line))));
    if (!is_same_word(trimmed(line.substr(0, colon)), "Content-Length")) continue;
    const std::string_view digits = trimmed(line.substr(colon + 1));
    std::size_t number = 0;
    const auto [rest, failure] =
        std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (failure != std::errc() || rest != digits.data() + digits.size() || number > kMaxBytes)
      return problem(fmt::format("'{}' is not a length of a message", brief(printable(digits))));
    length = number;
  }
  if (!length) return problem("a message has no Content-Length");
  return *length;
}

std::string framed(std::string_view message, Framing framing) {
  if (framing == Framing::Lines) return fmt::format("{}\n", message);
  return fmt::format("Content-Length: {}\r\n\r\n{}", message.size(), message);
}

}  // namespace lockstep::host

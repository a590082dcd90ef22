#include "show/web/server_sent.h"

#include <fmt/format.h>

#include <utility>

#include "record/json_lines.h"

namespace lockstep::host {
namespace {

// How often a listener gets something, so that it knows that the run is there, and the server
// who has gone.
constexpr std::chrono::milliseconds kBeat{1000};

constexpr std::string_view kData = "data: ";

}  // namespace

LoggedEvent sent_line(std::string_view line) {
  const auto tick = json_lines::tick_of(line);
  std::string text = tick ? fmt::format("id: {}\n", *tick) : std::string();
  text += kData;
  const std::size_t begin = text.size();
  (text += line) += '\n';
  return {.text = std::move(text),
          .line = begin,
          .length = line.size(),
          .tick = tick,
          .is_full = line.ends_with(json_lines::kFullEnd)};
}

LoggedEvent sent_event(std::string_view name, std::string_view json) {
  return {.text = fmt::format("event: {}\n{}{}\n\n", name, kData, json)};
}

ServerSent::ServerSent(LineLog& log, std::optional<std::uint64_t> seen)
    : log_(log), cursor_(log.begin(seen)), is_at_header_(!seen) {}

Stream::Piece ServerSent::read(std::span<char> to) {
  if (is_at_header_) return read_header(to);
  const std::size_t count = log_.read(cursor_, to);
  if (count > 0) return bytes(count);
  if (log_.is_over()) return {Piece::What::End};
  if (monotonic_now() - heard_ < kBeat) return {Piece::What::Wait};
  constexpr std::string_view kComment = ":\n\n";
  return bytes(kComment.copy(to.data(), to.size()));
}

Stream::Piece ServerSent::read_header(std::span<char> to) {
  const std::size_t count = log_.header().copy(to.data(), to.size(), in_header_);
  in_header_ += count;
  is_at_header_ = in_header_ < log_.header().size();
  return bytes(count);
}

Stream::Piece ServerSent::bytes(std::size_t count) {
  heard_ = monotonic_now();
  return {Piece::What::Bytes, count};
}

}  // namespace lockstep::host

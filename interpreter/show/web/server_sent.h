// The events of a log over HTTP, as the browser's EventSource reads them.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "base/core/clock.h"
#include "record/live/line_log.h"
#include "record/live/stream.h"

namespace lockstep::host {

// A line, which ends in '\n'.
LoggedEvent sent_line(std::string_view line);
// Something beside the lines.
LoggedEvent sent_event(std::string_view name, std::string_view json);

// The events behind a place in the log, for one listener.
class ServerSent final : public Stream {
 public:
  // For one who has seen the ticks up to this one, or none.
  ServerSent(LineLog& log, std::optional<std::uint64_t> seen);

  bool is_endless() const override { return true; }
  Piece read(std::span<char> to) override;

 private:
  Piece read_header(std::span<char> to);
  Piece bytes(std::size_t count);

  LineLog& log_;
  LineLog::Cursor cursor_;
  bool is_at_header_;
  std::size_t in_header_ = 0;
  Nanoseconds heard_{0};
};

}  // namespace lockstep::host

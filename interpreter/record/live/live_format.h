// A format whose lines reach listeners while the run goes on. They begin in the middle of it and
// may miss lines, so they must be told which line is which, and what was counted until then.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "record/live/line_format.h"

namespace lockstep::host {

class EventCounts;

// Reads again what set_tick_end has made: moments, faults and entries.
class TickEndReader {
 public:
  virtual ~TickEndReader() = default;
  virtual void read(std::string text, EventCounts& counts) = 0;
};

class LiveFormat : public LineFormat {
 public:
  // The tick of a line; none: it is a line of another kind.
  virtual std::optional<std::uint64_t> tick_of(std::string_view line) const = 0;
  // It is the last line.
  virtual bool is_end(std::string_view line) const = 0;
  // How each line ends that has the whole state, and no other.
  virtual std::string_view full_end() const = 0;
  // The text that goes before that: the counts up to this tick.
  virtual std::string counts_text(const EventCounts& counts, std::uint64_t tick) const = 0;
  virtual std::unique_ptr<TickEndReader> tick_end_reader() const = 0;

 protected:
  ~LiveFormat() = default;
};

}  // namespace lockstep::host

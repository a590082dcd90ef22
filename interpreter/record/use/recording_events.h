// The events of a recording, one after the other: which node began, completed, was halted, held
// or let go on, which entries changed, what leaves logged, which ticks are lost.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "record/read/recording_reader.h"
#include "record/tick_range.h"

namespace lockstep::host {

enum class EventKind : std::uint8_t {
  Start,
  Success,
  Failure,
  Skipped,
  Halt,
  Hold,
  Release,
  Pace,
  Fault,
  Ask,
  Answer,
  Entry,
  Log,
  Lost,
  End
};
// Of each, in this order: as --event and all formats spell it.
inline constexpr std::array<std::string_view, 15> kEventNames = {
    "start", "success", "failure", "skipped", "halt", "hold", "release", "pace",
    "fault", "ask",     "answer",  "entry",   "log",  "lost", "end"};
static_assert(kEventNames.size() == static_cast<std::size_t>(EventKind::End) + 1);

constexpr std::string_view to_string(EventKind kind) {
  return kEventNames[static_cast<std::size_t>(kind)];
}

struct RecordingEvent {
  std::uint64_t tick = 0;
  double time = 0;  // seconds
  EventKind kind{};
  std::string_view what;  // the path of the node, the key of the entry, who has logged; "": the run
  std::string value;      // of the entry; the message; "": there is none
};

// Returns false to stop.
using EventSink = std::function<bool(const RecordingEvent& event)>;

// The events of all readable ticks of the range; then check reader.error().
void each_event(RecordingReader& reader, TickRange range, const EventSink& take);

std::string event_line(const RecordingEvent& event);
std::string event_csv(const RecordingEvent& event);
std::string event_json(const RecordingEvent& event);

}  // namespace lockstep::host

// The format of json_lines.h for listeners, who also need to know which line is which, and counts.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "record/lines.h"
#include "record/live/event_counts.h"

namespace lockstep::host {

// How a line ends that has the whole state. No text in a line has a line end.
constexpr std::string_view kFullEnd = ",\"full\":true}\n";
static_assert(kFullEnd.substr(2, 4) == lines::kTick["full"]);

std::optional<std::uint64_t> tick_of_json(std::string_view line);
bool is_end_json(std::string_view line);
std::string counts_json(const EventCounts& counts, std::uint64_t tick);
std::unique_ptr<TickEndReader> json_tick_end_reader();

}  // namespace lockstep::host

// The pieces of a recording's lines that are written in every tick. Used by recorder and
// recording_delta.
#pragma once

#include <fmt/format.h>

#include <span>
#include <string_view>

#include "core/clock.h"
#include "engine/ticker.h"
#include "observers/recording.h"

namespace lockstep {

inline void append_text(fmt::memory_buffer& out, std::string_view text) {
  out.append(text.data(), text.data() + text.size());
}

// Nanoseconds as exact seconds, "0.03", where a double would say 0.030000000000000002.
void append_seconds(fmt::memory_buffer& out, Nanoseconds time);

// No node's part of a line is longer: [4294967295,"success",0.12345678901234567,1,0] and a comma.
constexpr std::size_t kMostOfNode = 64;
// [3,"running",0.25,1,0]
void append_node(fmt::memory_buffer& out, NodeIndex node, const RecordedState& state);

// [[3,"threw …"],…]; of a long message only the beginning.
void append_faults(fmt::memory_buffer& out, std::span<const Fault> faults);

// {"lost":{"ticks":2,"from":7}} and the end of the line.
void append_lost(fmt::memory_buffer& out, std::uint64_t ticks, std::uint64_t from);

}  // namespace lockstep

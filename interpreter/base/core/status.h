// The result of a tick, and whether a node is active. Idle means: not active; no tick returns it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/core/style.h"

namespace lockstep::host {

// The numbers are those of lockstep/leaf.h.
// Skipped: as if the node were not there in this tick.
enum class Status : std::uint8_t { Idle = 0, Running = 1, Success = 2, Failure = 3, Skipped = 4 };
inline constexpr Status kLastStatus = Status::Skipped;

// All that recordings, messages and views need to know of a status.
struct StatusRow {
  Status status;
  std::string_view name;     // as recordings and messages spell it
  std::string_view counted;  // "2 running, 9 succeeded"
  std::string_view sign, ascii_sign;
  Style style;
};

inline constexpr std::array kStatuses = {
    StatusRow{Status::Idle, "idle", "idle", "·", "-", Style::Dim},
    StatusRow{Status::Running, "running", "running", "▶", ">", Style::Active},
    StatusRow{Status::Success, "success", "succeeded", "✓", "+", Style::Good},
    StatusRow{Status::Failure, "failure", "failed", "✗", "x", Style::Bad},
    StatusRow{Status::Skipped, "skipped", "skipped", "»", "~", Style::Dim},
};

constexpr std::size_t index_of(Status status) {
  return static_cast<std::size_t>(status);
}

// How many have each status.
using StatusCounts = std::array<std::uint32_t, kStatuses.size()>;

static_assert(kStatuses.size() == index_of(kLastStatus) + 1 &&
                  std::ranges::all_of(kStatuses,
                                      [](const StatusRow& row) {
                                        return &kStatuses[index_of(row.status)] == &row;
                                      }),
              "each status has its row, in the order of the numbers");

constexpr const StatusRow& row_of(Status status) {
  return kStatuses[index_of(status)];
}

constexpr std::string_view to_string(Status status) {
  return row_of(status).name;
}

// The activation is over: the node's next tick begins another one.
constexpr bool has_ended(Status status) {
  return status > Status::Running;
}

// With a result that counts.
constexpr bool is_complete(Status status) {
  return status == Status::Success || status == Status::Failure;
}

}  // namespace lockstep::host

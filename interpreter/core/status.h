// The result of a tick, and whether a node is active. Idle means: not active; no tick returns it.
#pragma once

#include <cstdint>
#include <string_view>

namespace lockstep {

enum class Status : std::uint8_t { Idle = 0, Running = 1, Success = 2, Failure = 3 };

constexpr bool is_complete(Status status) {
  return status == Status::Success || status == Status::Failure;
}

// "idle", "running", "success" or "failure", as recordings and messages spell it.
constexpr std::string_view to_string(Status status) {
  constexpr std::string_view kNames[] = {"idle", "running", "success", "failure"};
  return kNames[static_cast<unsigned>(status)];
}

}  // namespace lockstep

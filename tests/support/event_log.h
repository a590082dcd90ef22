// What leaves were told, in order. Written by scripted leaves, compared by tests.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace lockstep::host::test {

enum class Call : std::uint8_t { Start, Tick, Halt, Pause, Resume };

constexpr std::string_view to_string(Call call) {
  constexpr std::string_view kNames[] = {"start", "tick", "halt", "pause", "resume"};
  return kNames[static_cast<unsigned>(call)];
}

struct Event {
  Call call;
  std::uint32_t leaf;  // its place among the leaves of the tree

  friend bool operator==(const Event&, const Event&) = default;
};

using EventLog = std::vector<Event>;

}  // namespace lockstep::host::test

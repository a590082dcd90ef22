// What leaves were told, in order. Written by scripted leaves, compared by tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

namespace lockstep::host::test {

enum class Call : std::uint8_t { Start, Tick, Halt, Pause, Resume, SetPace };

constexpr std::string_view to_string(Call call) {
  constexpr std::string_view kNames[] = {"start", "tick", "halt", "pause", "resume", "set_pace"};
  return kNames[static_cast<unsigned>(call)];
}

struct Event {
  Call call;
  std::uint32_t leaf;  // its place among the leaves of the tree
  double factor = 0;   // that it was told

  friend bool operator==(const Event& a, const Event& b) {
    return a.call == b.call && a.leaf == b.leaf && std::abs(a.factor - b.factor) < 1e-12;
  }
};

using EventLog = std::vector<Event>;

}  // namespace lockstep::host::test

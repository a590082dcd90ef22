#pragma once

#include <cstdint>

namespace lockstep::host {

// Decides what happens to a leaf of a program while a synchronized node withholds its ticks.
enum class Hold : std::uint8_t {
  AsItSays,  // Message for leaves that say so, else None
  Signal,    // its process group is stopped; each leaf has its own process
  Message,   // it gets `pause` and `resume`
  Answered,  // the same, and it answers `pause`
  None,
};

}  // namespace lockstep::host

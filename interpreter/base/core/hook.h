// The moments in the life of a node at which a script of it runs, in the order in which they are
// asked within a tick.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lockstep::host {

enum class Hook : std::uint8_t {
  // Before a tick of an idle node. True: the result without a tick.
  FailureIf,
  SuccessIf,
  SkipIf,
  While,  // also before a tick of a running node; false halts it, and it is skipped
  // After a tick that completes the node, or after it was halted.
  OnSuccess,
  OnFailure,
  Post,
  OnHalted,
};
inline constexpr std::size_t kHooks = 8;

}  // namespace lockstep::host

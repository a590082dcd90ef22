// The time of a call that went into the carrying of large values between processes. It is
// lockstep's own, so the leaf that is called is not blamed for it.
#pragma once

#include "core/clock.h"

namespace lockstep::host {

// A message that is smaller is not worth two looks at the clock.
constexpr std::size_t kMuchToCarry = std::size_t{64} << 10;

// The time of the call that this thread is in.
inline constinit thread_local Nanoseconds t_carried{0};

}  // namespace lockstep::host

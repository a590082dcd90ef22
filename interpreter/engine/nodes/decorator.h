// What decorators share. A decorator has one child, at self + 1.
#pragma once

#include "engine/nodes/kinds.h"
#include "engine/ticker.h"

namespace lockstep::decorator {

inline double child_progress(Ticker& ticker, NodeIndex self) {
  return ticker.progress(self + 1);
}

}  // namespace lockstep::decorator

// What leaves share that complete at once, and AlwaysRunning.
#pragma once

#include "engine/ticker.h"

namespace lockstep {

inline double no_progress(Ticker&, NodeIndex) {
  return 0.0;
}

}  // namespace lockstep

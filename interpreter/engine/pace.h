// Pacing: a node with pace="true" gives each child a factor in (0, 1], how fast it is to be, so
// that its children arrive together instead of being held. nodes/pacing.h has the law. A factor
// goes down the tree: a node that was given F, and asks f of a child, gives it F * f. Nobody is
// held or ticked because of one.
#pragma once

#include <algorithm>

#include "base/core/clock.h"

namespace lockstep::host {

// A factor, or that nothing is asked.
inline constexpr double kNoPace = 0;

inline double multiplied(double given, double asked) {
  if (given == kNoPace) return asked;
  return asked == kNoPace ? given : given * asked;
}

inline double factor_of(double given) {
  return given == kNoPace ? 1.0 : given;
}

inline constexpr double kLeastFactor = 0.01;
inline constexpr double kMostReaction = 60;  // s

// What a node that paces keeps of each child. At the start of an activation of the child: as new.
struct PacedChild {
  double begun = 0;        // the progress at the start of the activation
  double at_full = 0;      // s at factor 1 in which it would have come so far
  double counts = 1;       // the factor that counts: it falls as fast as a robot slows down
  double told = 1;         // the factor that the node asks of it, if it asks anything
  double rate = 0;         // 1/s at factor 1; 0: unknown
  double asked = kNoPace;  // by this node
  double given = kNoPace;  // with what comes from around it
};

// What such a node keeps beside that.
struct PacingState {
  Nanoseconds last;       // its last tick
  Nanoseconds paused_at;  // of a node that is held
  double given;           // in its last tick
};

// What a leaf that obeys keeps of its activation: what it was told last, and took up. After a cut
// nothing counts as told, because the leaf may have kept another speed.
struct LeafPace {
  double told;
  double taken;
};

}  // namespace lockstep::host

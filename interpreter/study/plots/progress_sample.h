// One sample of a plot of progress of a synchronized node, and the thinning of samples: a recording
// has millions, a picture a few hundred columns.
#pragma once

#include <cstddef>
#include <vector>

namespace lockstep::host {

struct ProgressSample {
  double time = 0;                  // seconds
  bool begins = false;              // a new activation of the node: no line leads here
  double least = 0;                 // of all children
  double limit = 0;                 // that counted: base/core/synchronization.h
  std::vector<double> progress;     // of each child that is drawn
  std::vector<double> held_until;   // of each: from `time` on; not later than it when not held
  std::vector<double> factor = {};  // of each, if the node paces
};

// Leaves those that give the same picture, when it has so many columns: of the line through a
// column the first, the least, the most and the last progress of each child, and how long it was
// held. At most kMostPerColumn samples for each column stay; four where no activation begins.
constexpr std::size_t kMostPerColumn = 8;
void thin(std::vector<ProgressSample>& samples, std::size_t columns);

}  // namespace lockstep::host

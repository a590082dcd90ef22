// The bar of a child of a synchronized node: what it has done, and where it has to wait.
#pragma once

#include <span>
#include <string>

namespace lockstep::host {

struct ProgressBar {
  double progress = 0;                  // in [0, 1], as all of them
  std::span<const double> marks = {};   // barriers, or the end of the delta band
  double band_begin = 0, band_end = 0;  // the delta band; empty: none
  std::size_t cells = 20;
};

// "[#####=|...]": done, still within the band, a mark, the rest. A mark at 1 is the bracket.
std::string to_text(const ProgressBar& bar, bool unicode);

}  // namespace lockstep::host

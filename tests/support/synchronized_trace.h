// Worked traces of the synchronized nodes, as the paper's algorithms give them:
//   12 1- .2   a digit: that leaf is ticked; '-': it is held; '.': it is idle or has succeeded.
// The first synchronized node is watched. The root succeeds in the last tick.
#pragma once

#include <span>
#include <string_view>

namespace lockstep::host::test {

struct SynchronizedTrace {
  std::string_view name;
  std::string_view tree;
  std::string_view leaves;
  std::string_view who;
  double distance;                 // the sum over ticks and pairs of children of |p_i - p_j|
  std::string_view progress = {};  // before each tick, "0,0 .2,.3"; "" = not compared
};

// Fails the Catch test for each trace that comes out differently.
void check_traces(std::span<const SynchronizedTrace> traces);

}  // namespace lockstep::host::test

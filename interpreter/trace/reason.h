// Why the result of a leaf's tick is what it is, in the words of the leaf: lockstep/ext/reason.h.
// Also the text of a fault after which the run goes on, of any node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "trace/node_state.h"

namespace lockstep::host {

constexpr std::size_t kMostOfReason = 600;  // bytes: who gives it has shortened it

struct Reason {
  NodeIndex node = 0;
  std::uint32_t number = 0;  // of the tick that it is of, as Moment::reached counts; 0: of none
  std::string text = {};
  bool of_fault = false;
};

}  // namespace lockstep::host

// Not in lockstep: the compiler says what to use instead.
#pragma once

#include "behaviortree_cpp/bt_factory.h"

namespace BT {

class TreeObserver {
 public:
  template <class... Arguments>
  explicit TreeObserver(Arguments&&...) {
    static_assert(
        sizeof...(Arguments) > 1000,
        "lockstep has no TreeObserver: 'lockstep log' counts the results of each node of a "
        "recording; lockstep_run_observe() of lockstep/runtime.h calls a function after each tick");
  }
};

}  // namespace BT

// Not in lockstep: the compiler says what to use instead.
#pragma once

#include "behaviortree_cpp/bt_factory.h"

namespace BT {

class FileLogger2 {
 public:
  template <class... Arguments>
  explicit FileLogger2(Arguments&&...) {
    static_assert(sizeof...(Arguments) > 1000,
                  "lockstep has no FileLogger2: 'lockstep run --record run.jsonl' records a run, "
                  "'lockstep replay' and 'lockstep log' read it");
  }
};

}  // namespace BT

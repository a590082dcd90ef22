// Not in lockstep: the compiler says what to use instead.
#pragma once

#include "behaviortree_cpp/bt_factory.h"

namespace BT {

class MinitraceLogger {
 public:
  template <class... Arguments>
  explicit MinitraceLogger(Arguments&&...) {
    static_assert(sizeof...(Arguments) > 1000,
                  "lockstep has no MinitraceLogger: 'lockstep run --record run.jsonl' records a "
                  "run, with the time of each tick");
  }
};

}  // namespace BT

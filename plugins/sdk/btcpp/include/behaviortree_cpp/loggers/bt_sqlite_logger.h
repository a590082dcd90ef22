// Not in lockstep: the compiler says what to use instead.
#pragma once

#include "behaviortree_cpp/bt_factory.h"

namespace BT {

class SqliteLogger {
 public:
  template <class... Arguments>
  explicit SqliteLogger(Arguments&&...) {
    static_assert(sizeof...(Arguments) > 1000,
                  "lockstep has no SqliteLogger: 'lockstep run --record run.jsonl' records a run, "
                  "'lockstep log' makes tables of it");
  }
};

}  // namespace BT

// Not in lockstep: the compiler says what to use instead.
#pragma once

#include "behaviortree_cpp/bt_factory.h"

namespace BT {

class SqliteLogger {
 public:
  template <class... Arguments>
  explicit SqliteLogger(Arguments&&...) {
    static_assert(
        sizeof...(Arguments) > 1000,
        "lockstep has no SqliteLogger: FileLogger2 writes a log for Groot2, and "
        "lockstep_run_record() of lockstep/runtime.h a recording, of which 'lockstep log' "
        "makes tables");
  }
};

}  // namespace BT

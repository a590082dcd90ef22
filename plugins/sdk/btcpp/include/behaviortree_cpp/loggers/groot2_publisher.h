// Not in lockstep: the compiler says what to use instead.
#pragma once

#include "behaviortree_cpp/bt_factory.h"

namespace BT {

class Groot2Publisher {
 public:
  template <class... Arguments>
  explicit Groot2Publisher(Arguments&&...) {
    static_assert(sizeof...(Arguments) > 1000,
                  "lockstep has no Groot2Publisher: 'lockstep run --groot2' shows a run in Groot2, "
                  "--monitor in a browser, --record keeps it");
  }
};

}  // namespace BT

// A row of a table of laws; tick_table.h says how it is written.
#pragma once

#include <string_view>

namespace lockstep::host::test {

struct TickRow {
  std::string_view law;
  std::string_view tree;
  std::string_view leaves;
  std::string_view expected;
  double period = 0.1;  // seconds from tick to tick; the first is at 0
};

}  // namespace lockstep::host::test

// The number of the tick that goes on: lockstep_ticks.
#include <algorithm>

#include "engine/node_context.h"
#include "leaves/plugin/contract/host.h"

namespace lockstep::host {
namespace {

std::uint64_t number(const lockstep_caller* caller) {
  if (caller->is_foreign()) return 0;
  if (caller->run->node_context != nullptr) return caller->run->node_context->tick_number();
  const auto period = std::max<std::int64_t>(caller->time->period.count(), 1);
  return static_cast<std::uint64_t>(std::max<std::int64_t>(caller->time->now.count(), 0) / period);
}

}  // namespace

const lockstep_ticks& ticks_table() {
  static constexpr lockstep_ticks kTable{.struct_size = sizeof(lockstep_ticks), .number = number};
  return kTable;
}

}  // namespace lockstep::host

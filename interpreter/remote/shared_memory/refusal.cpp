#include "remote/shared_memory/refusal.h"

#include <fmt/format.h>

namespace lockstep {

std::optional<Problem> refuse_isolation(const Descriptors::Leaf& leaf) {
  for (const Parameter& port : leaf.parameters) {
    if (port.object == nullptr || port.object->has_bytes()) continue;
    return Problem{fmt::format("cannot be isolated: the port '{}' of '{}' carries objects, and the "
                               "type '{}' has no to_bytes and from_bytes",
                               port.name, leaf.type.id, port.object->name()),
                   "load it without isolation, or give the type both functions"};
  }
  // The children of a control node are leaves of other processes, or of this one.
  if (leaf.type.kind != LOCKSTEP_CONTROL && leaf.type.kind != LOCKSTEP_DECORATOR) {
    return std::nullopt;
  }
  return Problem{fmt::format("cannot be isolated: '{}' is a {}", leaf.type.id,
                             leaf.type.kind == LOCKSTEP_CONTROL ? "control node" : "decorator"),
                 "load it without isolation, or move its leaves into another plugin"};
}

}  // namespace lockstep

#include "engine/blackboard.h"

namespace lockstep::host {

void Blackboard::reset(const Tree& tree) {
  entries.resize(tree.slots.size());
  for (std::size_t slot = 0; slot < entries.size(); ++slot) {
    const Slot& it = tree.slots[slot];
    // A start value counts as written where writes can be waited for.
    const bool is_written =
        it.typing != Typing::Strict && !std::holds_alternative<NoValue>(it.initial);
    entries[slot] = {.value = it.initial,
                     .writes = is_written ? 1u : 0u,
                     .type = it.type,
                     .typing = it.typing,
                     .is_present = it.is_present,
                     .object = it.object};
  }
}

}  // namespace lockstep::host

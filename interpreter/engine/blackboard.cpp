#include "engine/blackboard.h"

namespace lockstep::host {

Blackboard::Blackboard(const Tree& tree)
    : entries(tree.slots.size()),
      names(tree.boards, entries),
      lock(tree.shares_entries ? std::make_shared<EntriesLock>() : nullptr) {
  reset(tree);
}

void Blackboard::reset(const Tree& tree) {
  names.reset();
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

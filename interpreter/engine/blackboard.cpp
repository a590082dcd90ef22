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
    Entry& entry = entries[slot];
    entry = Entry(it.typing, it.type, it.object);
    entry.is_present = it.is_present;
    entry.assign(it.initial);
    // A start value counts as written where writes can be waited for.
    entry.count_from(it.typing != Typing::Strict && entry.has_value() ? 1 : 0);
  }
}

}  // namespace lockstep::host

#include "engine/blackboard.h"

namespace lockstep {

void Blackboard::reset(const Tree& tree) {
  entries.resize(tree.slots.size());
  for (std::size_t slot = 0; slot < entries.size(); ++slot) {
    const Slot& it = tree.slots[slot];
    entries[slot] = {.value = it.initial,
                     .type = it.type,
                     .typing = it.typing,
                     .is_present = it.is_present,
                     .object = it.object};
  }
}

}  // namespace lockstep

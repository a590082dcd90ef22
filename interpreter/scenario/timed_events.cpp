#include "scenario/timed_events.h"

namespace lockstep::host {

void EntryWriter::before_tick(const Moment&, std::uint64_t tick, Nanoseconds time) {
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    const PreparedChange& it = changes_[i];
    const bool is_due = it.time ? time >= from_seconds(*it.time) : tick >= it.tick;
    if (is_done_[i] || !is_due) continue;
    is_done_[i] = true;
    const Slot& slot = run_.ticker().tree().slots[it.slot];
    Entry& entry = run_.blackboard().entries[it.slot];
    entry.is_present = true;
    write_entry(entry, slot.type, slot.object, it.value);
  }
}

void LateTicks::after_tick(const Moment&, const TickReport& report) {
  for (const LateTick& it : late_) {
    if (it.tick == report.tick) clock_.pass(from_seconds(it.by));
  }
}

}  // namespace lockstep::host

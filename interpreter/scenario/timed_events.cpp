#include "scenario/timed_events.h"

#include <fmt/format.h>

#include "run/set_entry.h"

namespace lockstep::host {

void EntryWriter::before_tick(const Moment&, std::uint64_t tick, Nanoseconds time) {
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    const PreparedChange& it = changes_[i];
    const bool is_due = it.time ? time >= from_seconds(*it.time) : tick >= it.tick;
    if (is_done_[i] || !is_due) continue;
    is_done_[i] = true;
    const Slot& slot = run_.ticker().tree().slots[it.slot];
    Entry& entry = run_.blackboard().entries[it.slot];
    if (set_entry(entry, slot.type, slot.object, it.value)) continue;
    surprises_.push_back(
        {it.place, fmt::format("in tick {}, '{}' cannot be set to {}: it is {}", tick, slot.name,
                               to_text(it.value), to_text(entry.value()))});
  }
}

void Answerer::before_tick(const Moment&, std::uint64_t tick, Nanoseconds time) {
  Ticker& ticker = run_.ticker();
  for (std::size_t i = 0; i < answers_.size(); ++i) {
    const PreparedAnswer& it = answers_[i];
    const AnswerEvent& of = *it.of;
    const bool is_due = of.time ? time >= from_seconds(*of.time) : tick >= of.tick.value_or(0);
    if (is_done_[i] || !is_due) continue;
    const bool is_once = of.time || of.tick;
    is_done_[i] = is_once;
    const bool is_taken =
        ticker.answer(it.node, {it.option, of.value, "scenario"}, ticker.tick_number());
    if (is_taken || !is_once) continue;
    surprises_.push_back(
        {of.path_place, fmt::format("'{}' does not ask before tick {}, so '{}' answers nothing",
                                    ticker.tree().path(it.node), tick, of.value)});
  }
}

void LateTicks::after_tick(const Moment&, const TickReport& report) {
  for (const LateTick& it : late_) {
    if (it.tick == report.tick) clock_.pass(from_seconds(it.by));
  }
}

}  // namespace lockstep::host

#include "judge/measure/held.h"

namespace lockstep::host {

void HeldChild::after_tick(const TickView& view) {
  const SynchronizedTick& tick = view.parallels[place_];
  if (tick.is_of_others) return;  // as it was held until then, it is until its own next tick
  pass_time(tick.time);
  const bool held = tick.ticked && tick.held[child_];
  reached_ |= tick.ticked;
  ticks_ += held;
  held_ = held && tick.status == Status::Running;
  if (!tick.ticked && tick.status == Status::Running) return;
  pauses_ += held && !paused_;
  paused_ = held_;
}

void HeldChild::pass_time(Nanoseconds time) {
  if (held_) time_ += time - last_;
  last_ = time;
}

namespace {

class Pauses final : public HeldChild {
 public:
  using HeldChild::HeldChild;
  double value(const EndView&) const override { return of_reached(pauses()); }
};

}  // namespace

extern const Measure kHeld{
    .name = "held",
    .argument = ":NODE",
    .of = MeasureOf::Child,
    .axis = "held",
    .unit = "ticks",
    .doc =
        "how many of its ticks the synchronized node withheld from NODE, including the one in "
        "which it ended",
    .make = make_accumulator<HeldChild>,
    .is_possible = is_count_of_ticks};

extern const Measure kPauses{
    .name = "pauses",
    .argument = ":NODE",
    .of = MeasureOf::Child,
    .axis = "pauses",
    .doc = "how often the synchronized node paused NODE: withheld ticks in a row are one pause",
    .make = make_accumulator<Pauses>,
    .is_possible = is_count_of_ticks};

}  // namespace lockstep::host

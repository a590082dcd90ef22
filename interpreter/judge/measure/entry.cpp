// A number on the blackboard after the last tick.
#include "judge/measure/measure.h"

namespace lockstep::host {
namespace {

class EntryAtEnd final : public Accumulator {
 public:
  explicit EntryAtEnd(const MeasureTarget& target) : place_(target.place) {}
  void reset() override { number_ = kNoValue; }
  void after_tick(const TickView& view) override { number_ = view.entries[place_]; }
  double value(const EndView&) const override {
    return std::isfinite(number_) ? number_ : kNoValue;
  }

 private:
  std::size_t place_;
  double number_ = kNoValue;
};

}  // namespace

extern const Measure kEntry{
    .name = "entry",
    .argument = ":KEY",
    .of = MeasureOf::Entry,
    .axis = "entry",
    .doc = "the number in the blackboard entry KEY after the last tick; 1 or 0 for a bool",
    .make = make_accumulator<EntryAtEnd>,
    .is_possible = [](double value, const MeasureSpec&,
                      const MeasuredRun&) { return std::isfinite(value); },
    .label = [](const MeasureSpec& spec) { return spec.name; }};

}  // namespace lockstep::host

// The measures of a whole run, which follow from its end.
#include "judge/measure/measure.h"

namespace lockstep::host {
namespace {

template <double (*kValue)(const EndView& end)>
class AtEnd final : public Accumulator {
 public:
  explicit AtEnd(const MeasureTarget&) {}
  void reset() override {}
  void after_tick(const TickView&) override {}
  double value(const EndView& end) const override { return kValue(end); }
};

double ticks_of(const EndView& end) {
  return static_cast<double>(end.ticks);
}

// A tick lasts until the next would begin, also the last, unless the end of the run is known.
double duration_of(const EndView& end) {
  if (end.real_time && end.ended) return to_seconds(*end.ended);
  if (end.ticks == 0 || end.rate == 0) return to_seconds(end.last);
  if (!end.real_time) return ticks_of(end) / end.rate;
  return to_seconds(end.last + from_seconds(1 / end.rate));
}

double success_of(const EndView& end) {
  return end.succeeded ? static_cast<double>(*end.succeeded) : kNoValue;
}

}  // namespace

extern const Measure kDuration{
    .name = "duration",
    .axis = "duration",
    .unit = "s",
    .doc =
        "seconds: ticks / rate; on a real clock: until the end of the run; for a truncated "
        "recording: until a period after the start of the last tick; for a run that `--max-ticks` "
        "ended: until then",
    .make = make_accumulator<AtEnd<duration_of>>,
    .is_possible = [](double value, const MeasureSpec&, const MeasuredRun& run) {
      return value == static_cast<double>(run.ticks) / run.rate;
    }};

extern const Measure kTicks{
    .name = "ticks",
    .axis = "ticks",
    .doc = "the number of its ticks",
    .make = make_accumulator<AtEnd<ticks_of>>,
    .is_possible = [](double value, const MeasureSpec&, const MeasuredRun& run) {
      return value == static_cast<double>(run.ticks);
    }};

extern const Measure kSuccess{
    .name = "success",
    .axis = "success",
    .doc = "1 if the root succeeded, otherwise 0",
    .make = make_accumulator<AtEnd<success_of>>,
    .is_possible = [](double value, const MeasureSpec&, const MeasuredRun& run) {
      return value == (run.succeeded ? 1 : 0);
    }};

}  // namespace lockstep::host

#include "judge/measure/measure.h"

namespace lockstep::host {

extern const Measure kProgressDistance, kProgressDistanceMean, kProgressDistanceSeconds, kSpread,
    kStepLength, kHeld, kHeldBy, kPauses, kFactor, kSpeedChanges, kWaits, kFairness, kDuration,
    kTicks, kSuccess, kEntry, kPredictability;

// In the order in which they are documented.
std::span<const Measure* const> all_measures() {
  static constexpr const Measure* kMeasures[] = {&kProgressDistance,
                                                 &kProgressDistanceMean,
                                                 &kProgressDistanceSeconds,
                                                 &kSpread,
                                                 &kStepLength,
                                                 &kHeld,
                                                 &kHeldBy,
                                                 &kPauses,
                                                 &kFactor,
                                                 &kSpeedChanges,
                                                 &kWaits,
                                                 &kFairness,
                                                 &kDuration,
                                                 &kTicks,
                                                 &kSuccess,
                                                 &kEntry,
                                                 &kPredictability};
  return kMeasures;
}

}  // namespace lockstep::host

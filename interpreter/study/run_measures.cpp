#include "study/run_measures.h"

#include <algorithm>

#include "judge/measure/measure_spec.h"

namespace lockstep::host {
RunMeasures::RunMeasures(const Shape& shape, std::span<const MeasureSpec> measures, double rate)
    : measuring_(shape, measures), rate_(rate) {
  for (const auto& [spec, node] : measuring_.columns()) {
    columns_.push_back({to_text(*spec), node});
    if (!spec->measure->has_gap) continue;
    columns_.push_back(columns_.back());
    columns_.back().is_gap = true;
  }
  values_.resize(columns_.size(), kNoValue);
}

void RunMeasures::run_started(const Moment&, const RunStart& start) {
  real_time_ = start.real_time;
  measuring_.reset();
  std::ranges::fill(values_, kNoValue);
}

void RunMeasures::after_tick(const Moment& moment, const TickReport&) {
  after_tick(moment);
}

void RunMeasures::run_ended(const Moment&, const RunEnd& end) {
  const EndView view{.ticks = end.ticks,
                     .last = last_,
                     .rate = rate_,
                     .real_time = real_time_,
                     .succeeded = end.result() == RunResult::Success,
                     .ended = end.time};
  double* next = values_.data();
  for (std::size_t column = 0; column < measuring_.columns().size(); ++column) {
    *next++ = measuring_.value(column, view);
    if (measuring_.columns()[column].spec->measure->has_gap) *next++ = measuring_.gap(column);
  }
}

}  // namespace lockstep::host

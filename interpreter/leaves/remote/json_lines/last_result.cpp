#include "leaves/remote/json_lines/last_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/core/tick_budget.h"

namespace lockstep::host {
namespace {

constexpr Nanoseconds kLongestWait = std::chrono::milliseconds(2);
constexpr int kPartOfPeriod = 5;
constexpr int kPeriods = 5;  // that a result lasts
constexpr Nanoseconds kBetweenWarnings = std::chrono::seconds(10);

}  // namespace

LastResult::LastResult(const LeafTime& time, const IsolationOptions& options)
    : time_(time),
      wait_(options.condition_wait.value_or(
          std::min<Nanoseconds>(time.period / kPartOfPeriod, kLongestWait))),
      age_(options.condition_age.value_or(time.period * kPeriods)) {}

void LastResult::begin_tick() {
  tick_before_ = std::exchange(tick_, time_.now);
}

// Since the tick before, less time has passed in the run than on the clock if the run was paused.
void LastResult::keep(lockstep_status status, Nanoseconds ago) {
  last_ = {status, std::max(tick_before_, time_.now - ago)};
}

Nanoseconds LastResult::patience() const {
  return time_.budget == nullptr ? wait_ : time_.budget->left(time_.now, wait_);
}

void LastResult::note_wait(Nanoseconds waited) const {
  if (time_.budget != nullptr) time_.budget->use(waited);
}

lockstep_status LastResult::now() const {
  return last_ && time_.now - last_->when <= age_ ? last_->status : LOCKSTEP_RUNNING;
}

std::string LastResult::warning() {
  std::optional<Nanoseconds>& told = told_[last_ ? 1 : 0];
  if (told && time_.now - *told < kBetweenWarnings) return {};
  told = time_.now;
  const std::string why =
      last_ ? fmt::format("its last result is older than {:g} s, the limit of --condition-age",
                          to_seconds(age_))
            : fmt::format("it has no result yet, and a tick waits {:g} s at most: --condition-wait",
                          to_seconds(wait_));
  return fmt::format(
      "the answer of this condition is late: {}. Until it comes, the condition is Running, "
      "and an action behind it does not run",
      why);
}

}  // namespace lockstep::host

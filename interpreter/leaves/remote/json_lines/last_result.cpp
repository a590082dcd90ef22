#include "leaves/remote/json_lines/last_result.h"

#include <fmt/format.h>

#include <algorithm>

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

Nanoseconds LastResult::patience() const {
  return time_.budget == nullptr ? wait_ : time_.budget->left(time_.now, wait_);
}

void LastResult::note_wait(Nanoseconds waited) const {
  if (time_.budget != nullptr) time_.budget->use(waited);
}

lockstep_status LastResult::at(Nanoseconds now) const {
  return last_ && now - last_->when <= age_ ? last_->status : LOCKSTEP_RUNNING;
}

std::string LastResult::warning(Nanoseconds now) {
  std::optional<Nanoseconds>& told = told_[last_ ? 1 : 0];
  if (told && now - *told < kBetweenWarnings) return {};
  told = now;
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

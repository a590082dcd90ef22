#include "base/core/end_budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/core/wording.h"

namespace lockstep::host {

std::optional<Nanoseconds> EndBudget::rest() const {
  if (!limit_ || !end_) return std::nullopt;
  return std::max(*end_ - monotonic_now(), kLeast);
}

std::optional<Nanoseconds> EndBudget::share() const {
  if (!limit_ || !end_) return std::nullopt;
  return std::max((*end_ - monotonic_now()) / 2, kLeast);
}

Nanoseconds EndBudget::share(Nanoseconds wanted) const {
  return std::min(wanted, share().value_or(wanted));
}

void EndBudget::used_up_by(std::string who) {
  const std::lock_guard lock(mutex_);
  if (std::ranges::find(users_, who) == users_.end()) users_.push_back(std::move(who));
}

std::string EndBudget::note() const {
  const std::lock_guard lock(mutex_);
  if (!limit_ || !end_ || users_.empty() || monotonic_now() < *end_) return {};
  return fmt::format("the end of the run took longer than --halt-limit ({:g} s): it waited for {}",
                     to_seconds(*limit_), joined(users_, " and "));
}

}  // namespace lockstep::host

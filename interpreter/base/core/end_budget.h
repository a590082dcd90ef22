// The time that the end of a run may take: all that still waits after the last halt, for somebody
// outside, shares it, and who used it up is named. A robot that stands still is not to be kept from
// its next run by a browser, a full disk or a program that does not end.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/core/clock.h"

namespace lockstep::host {

class EndBudget {
 public:
  // Everybody may wait so long, however long others have waited before.
  static constexpr Nanoseconds kLeast = std::chrono::milliseconds(100);

  // Nothing: it has no limit.
  explicit EndBudget(std::optional<Nanoseconds> limit) : limit_(limit) {}
  // The last halt is over. Before that there is no limit either.
  void begin() { end_ = monotonic_now() + limit_.value_or(Nanoseconds(0)); }

  // How long to wait, of those who want so long; nothing: for ever. A share leaves as much to those
  // who come after.
  std::optional<Nanoseconds> rest() const;
  std::optional<Nanoseconds> share() const;
  Nanoseconds share(Nanoseconds wanted) const;

  // "the program 'grip'": it was waited for in vain. Any thread.
  void used_up_by(std::string who);
  // Once the time is over, who has used it up; "" before.
  std::string note() const;

 private:
  std::optional<Nanoseconds> limit_, end_;
  mutable std::mutex mutex_;
  std::vector<std::string> users_;
};

}  // namespace lockstep::host

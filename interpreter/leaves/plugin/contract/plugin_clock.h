// A clock of a plugin as the clock of a run: lockstep/ext/clock.h.
#pragma once

#include <optional>
#include <string>

#include "base/core/clock.h"
#include "lockstep/ext/clock.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

// Null: the plugin has none.
const lockstep_clock* clock_of(const lockstep_plugin& plugin);

// Time passes as it does there, and stands where it stands. It never goes back: after a jump back
// it goes on from the last time.
class PluginClock final : public Clock {
 public:
  explicit PluginClock(const lockstep_clock& clock) : clock_(clock) {}

  // The reason why it cannot; nothing: it is open.
  std::optional<std::string> open();
  bool has_time() const { return clock_.now() >= 0; }

  Nanoseconds now() override;
  void sleep_until(Nanoseconds deadline) override;
  bool is_real() const override { return true; }

 private:
  const lockstep_clock& clock_;
  std::int64_t there_ = 0;  // the last time of the plugin
  std::int64_t now_ = 0;
  bool has_begun_ = false;
};

}  // namespace lockstep::host

// The results of a condition whose answers may be late. On the wall clock a tick waits a bounded
// time for the answer. After that the condition has its last result, until that is too old.
#pragma once

#include <optional>
#include <string>

#include "base/core/clock.h"
#include "leaves/plugin/contract/leaf_set.h"
#include "leaves/remote/isolation_options.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

class LastResult {
 public:
  LastResult(const LeafTime& time, const IsolationOptions& options);

  // First in each tick of the condition. Ages are of the time of the run, which stands while the
  // run is paused.
  void begin_tick();

  // How long this tick may still wait for the answer.
  Nanoseconds patience() const;
  void note_wait(Nanoseconds waited) const;

  // An answer has come, whichever question it is for, so long ago on the clock of the machine.
  void keep(lockstep_status status, Nanoseconds ago);
  // However old it is; there is one.
  lockstep_status status() const { return last_->status; }
  // Running: there is none, or it is too old.
  lockstep_status now() const;
  // For the log, when it is Running for that; "": that was said a short time ago.
  std::string warning();

 private:
  struct Result {
    lockstep_status status = LOCKSTEP_RUNNING;
    Nanoseconds when{0};
  };
  const LeafTime& time_;
  const Nanoseconds wait_, age_;
  Nanoseconds tick_{0}, tick_before_{0};  // of the condition
  std::optional<Result> last_;
  std::optional<Nanoseconds> told_[2];  // that there was none, and that it was too old
};

}  // namespace lockstep::host

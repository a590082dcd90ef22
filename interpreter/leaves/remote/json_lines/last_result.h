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

  // How long this tick may still wait for the answer.
  Nanoseconds patience() const;
  void note_wait(Nanoseconds waited) const;

  // An answer has come, whichever question it is for.
  void keep(lockstep_status status, Nanoseconds when) { last_ = {status, when}; }
  // However old it is; there is one.
  lockstep_status status() const { return last_->status; }
  // Running: there is none, or it is too old.
  lockstep_status at(Nanoseconds now) const;
  // For the log, when it is Running for that; "": that was said a short time ago.
  std::string warning(Nanoseconds now);

 private:
  struct Result {
    lockstep_status status = LOCKSTEP_RUNNING;
    Nanoseconds when{0};
  };
  const LeafTime& time_;
  const Nanoseconds wait_, age_;
  std::optional<Result> last_;
  std::optional<Nanoseconds> told_[2];  // that there was none, and that it was too old
};

}  // namespace lockstep::host

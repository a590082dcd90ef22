// The threads of leaves in a run on the virtual clock: lockstep_workers of the contract. They take
// turns, in the order in which they began, and the run waits for each: so they, and what they log,
// are the same every time. A turn ends when the worker waits for a time, or ends.
#pragma once

#include <condition_variable>
#include <memory>
#include <vector>

#include "base/core/clock.h"
#include "base/system/call_mark.h"
#include "base/system/mutex.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

class Workers {
 public:
  Workers();
  ~Workers();  // all have been finished
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  // For the thread of the run. All turns that are due at this time, counted since the run began,
  // each at most once. Nothing if there is no worker.
  void give_turns(Nanoseconds now) {
    if (!all_.empty()) give_all(to_seconds(now));
  }

  lockstep_worker* begin(const CallSite& site, double now);
  // Gives the worker turns until it has ended, and forgets it.
  static void finish(lockstep_worker* worker);

  // For the thread of the worker.
  static void start(lockstep_worker* worker);
  static bool wait(lockstep_worker* worker, double until);
  static void end(lockstep_worker* worker);
  static double now(lockstep_worker* worker);
  // Any thread.
  static void wake(lockstep_worker* worker);

 private:
  void give_all(double now);
  void give_turn(lockstep_worker& worker);
  void await_turn(lockstep_worker& worker, Lock& lock) LOCKSTEP_REQUIRES(mutex_);

  Mutex mutex_;
  std::condition_variable turn_over_;
  CallMark* waiting_ LOCKSTEP_GUARDED_BY(mutex_) =
      nullptr;  // of the run's thread, while a worker has its turn
  double now_ LOCKSTEP_GUARDED_BY(mutex_) = 0;
  std::vector<std::unique_ptr<lockstep_worker>> all_;  // only the run's thread changes it
};

// The table that plugins get.
const lockstep_workers& workers_table();

}  // namespace lockstep::host

#include "study/study_run.h"

#include <algorithm>

#include "base/system/own_thread.h"
#include "run/shape_of.h"

namespace lockstep::host {

StudyRun::StudyRun(const StudyCell& cell, std::span<const MeasureSpec> measures,
                   std::uint64_t max_ticks, int (*stop_signal)())
    : cell_(cell),
      deadlines_(cell.rate),
      max_ticks_(std::min(max_ticks, deadlines_.first_from(kLongestRun))),
      stop_signal_(stop_signal),
      measures_(shape_of(cell.tree), measures, cell.rate),
      moments_(cell.tree, measures_.asked()) {}

RunEnd StudyRun::run(std::uint64_t seed) {
  begin(seed);
  RunEnd end;
  if (run_->fault() == nullptr) {  // of a leaf that could not be created
    while (may_tick(end) && tick(end)) {
    }
  }
  end.time = deadlines_.at(end.ticks);
  run_->halt();
  if (run_->fault() != nullptr) {
    end.reason = StopReason::Fault;
    end.fault = *run_->fault();
  }
  const InEngine scope(run_->blackboard().lock.get());
  measures_.run_ended(moments_.now(run_->ticker()), end);
  return end;
}

void StudyRun::begin(std::uint64_t seed) {
  if (run_) {
    run_->restart(seed);
  } else {
    run_.emplace(
        cell_.tree,
        RunOptions{
            .seed = seed, .rate = cell_.rate, .log = {}, .virtual_time = true, .watch = &watch_});
  }
  measures_.run_started(moments_.now(run_->ticker()), {run_->period(), false});
}

bool StudyRun::may_tick(RunEnd& end) const {
  rethrow_thread_failure();
  if (stop_signal_ != nullptr && stop_signal_() != 0) [[unlikely]] {
    end.signal = stop_signal_();
    end.reason = StopReason::Signal;
    return false;
  }
  if (end.ticks < max_ticks_) return true;
  end.reason = StopReason::MaxTicks;
  return false;
}

// True while the run goes on.
bool StudyRun::tick(RunEnd& end) {
  Ticker& ticker = run_->ticker();
  EntriesLock* const lock = run_->blackboard().lock.get();
  end.last = deadlines_.at(end.ticks);
  run_->set_now(end.last);
  {
    const InEngine scope(lock);
    moments_.before_tick(ticker);
  }
  end.status = run_->tick();
  {
    const InEngine scope(lock);
    measures_.after_tick(moments_.after_tick(ticker, end.ticks, end.last));
  }
  ++end.ticks;
  return !ticker.faulted() && !has_ended(end.status);
}

}  // namespace lockstep::host

// Observes a run: the loop calls it (run/observers.h), on the tick thread, around each tick. An
// observer only reads and never changes the run. It does long work in a separate thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/core/clock.h"
#include "base/core/end_budget.h"
#include "base/core/status.h"
#include "trace/faults.h"
#include "trace/moment.h"

namespace lockstep::host {

struct RunStart {
  Nanoseconds period{0};
  bool real_time = true;  // false on a virtual clock: periods and lateness have no meaning
  // Of a run that continues after a cut. Its ticks and its time count from the beginning of the
  // run.
  std::uint64_t first_tick = 0;
  Nanoseconds gap{0};                       // since its state was saved
  std::span<const std::uint32_t> set = {};  // slots that came from outside before its first tick
};

struct TickReport {
  std::uint64_t tick = 0;              // counts from 0; of a run that was cut, over its parts
  Nanoseconds time{0};                 // when it began, since the run began
  Status status = Status::Running;     // of the root
  std::uint64_t skipped = 0;           // deadlines that were skipped because this tick was late
  std::span<const Fault> faults = {};  // of leaves, since the last report; the run goes on
  Nanoseconds late{0};                 // it began so long after its deadline; 0 on a virtual clock
};

enum class StopReason : std::uint8_t {
  Completed,
  Fault,
  Timeout,
  MaxTicks,
  Signal,
  Overrun,
  Recording,
  Property,
  Stopped  // by the program that ticks the tree
};

// The longest tick, from its beginning until the root had its status; real time only.
struct WorstTick {
  std::uint64_t tick = 0;
  Nanoseconds took{0};            // 0: there is none
  std::optional<NodeIndex> leaf;  // whose call took most of it, when calls were timed
  Nanoseconds leaf_took{0};
};

enum class RunResult : std::uint8_t {
  Success,  // of the root
  Failure,  // of the root
  Stopped,  // while the root was still running
  Fault,    // a leaf failed as a program
  Skipped,  // the root was
};

struct RunEnd {
  StopReason reason = StopReason::Completed;
  Status status = Status::Running;  // of the root after the last tick
  int signal = 0;                   // when reason is Signal
  std::optional<Fault> fault;       // of a leaf, in a tick or when it was created
  std::uint64_t ticks = 0;          // in all: also those before a cut
  std::uint64_t first_tick = 0;     // of this process
  Nanoseconds time{0};              // from the start of the first tick to the end of the last
  Nanoseconds last{0};              // when the last tick began
  std::uint64_t overruns = 0;       // ticks that ended after the next deadline
  std::uint64_t skipped = 0;        // deadlines skipped because of them
  WorstTick worst;
  EndBudget* budget = nullptr;  // the time that observers of the end may take; null: no limit

  bool has_ticked() const { return ticks > first_tick; }

  RunResult result() const {
    if (reason == StopReason::Fault) return RunResult::Fault;
    if (reason != StopReason::Completed) return RunResult::Stopped;
    if (status == Status::Skipped) return RunResult::Skipped;
    return status == Status::Success ? RunResult::Success : RunResult::Failure;
  }
};

// A Moment is the run after its last tick, also where it is given before the next one, and after
// the last halt. Valid during the call.
class Observer {
 public:
  virtual ~Observer() = default;
  // What its Moments must have. Called before the run.
  virtual AskedOfRun asked() const { return {}; }
  virtual void run_started(const Moment&, const RunStart&) {}
  virtual void before_tick(const Moment&, std::uint64_t /*tick*/, Nanoseconds /*time*/) {}
  virtual void after_tick(const Moment&, const TickReport&) {}
  // The run stands after a tick: it is paused, or ends. Before leaves are paused or halted.
  virtual void standing(const Moment&) {}
  // After every running leaf was halted. LiveRun::tolerated() has the faults since the last report.
  virtual void run_ended(const Moment&, const RunEnd&) {}
};

}  // namespace lockstep::host

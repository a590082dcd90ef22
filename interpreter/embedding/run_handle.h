// The object behind lockstep_run. Only within embedding/.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/core/problem.h"
#include "embedding/handles.h"
#include "embedding/node_calls.h"
#include "embedding/run_limits.h"
#include "embedding/run_properties.h"
#include "embedding/run_watchers.h"
#include "embedding/warnings.h"
#include "run/kept_run.h"
#include "run/run.h"

struct lockstep_run {
  struct ObserverCall {
    lockstep_observe observe;
    void* user;
  };

  lockstep_run(std::shared_ptr<const lockstep::host::Program> loaded,
               lockstep::host::RunOptions options, lockstep::host::embedding::RunLimits given)
      : rate(options.rate),
        seed(options.seed),
        is_real(!options.virtual_time),
        fails_on_fault(options.on_fault == lockstep::host::FaultPolicy::Fail),
        program(std::move(loaded)),
        log(std::move(options.log)),
        limits(std::move(given), program->runnable.tree, leaf_log()),
        watchers(program->runnable.tree,
                 {.tree_file = program->file,
                  .rate_hz = options.rate,
                  .seed = options.seed,
                  .arguments = lockstep::host::values_of(program->runnable.arguments),
                  .values = program->runnable.values},
                 {.period = lockstep::host::deadline_of(1, options.rate),
                  .real_time = !options.virtual_time}),
        properties(program->runnable.tree),
        warnings(program->runnable.tree, leaf_log()),
        run(program->runnable.tree, with_own(std::move(options))) {}
  ~lockstep_run() { end(); }

  // Lines of leaves go to the program, and to those who watch.
  lockstep::host::LeafLog leaf_log() {
    return [this](std::string_view who, lockstep_log_level level, std::string_view line) {
      watchers.log(who, lockstep::host::name_of(level), line);
      if (log) log(who, level, line);
    };
  }
  // From this one on.
  void tell_fresh_properties(std::size_t first) {
    for (const std::string& it : properties.fresh().subspan(first))
      leaf_log()("lockstep", LOCKSTEP_LOG_INFO, lockstep::host::fresh_property_text(it));
  }
  lockstep::host::RunOptions with_own(lockstep::host::RunOptions options) {
    options.log = leaf_log();
    options.watch = limits.leaf_watch();
    return options;
  }
  // The end of what is watched and kept.
  void end() {
    if ((watchers.empty() && kept == nullptr) || !process.is_this()) return;
    run.halt();
    watchers.end(run.ticker(), last);
    if (kept != nullptr) kept->end(last);
    forget_kept();
  }
  void forget_kept() {
    if (kept != nullptr) not_kept = kept->error();
    kept.reset();
  }
  // Nothing has ticked it, in this process.
  bool is_new() { return run.ticker().tick_number() == first_tick; }

  void notify(double seconds, lockstep_status status,
              std::span<const lockstep::host::Fault> faults) {
    const std::uint64_t tick = run.ticker().tick_number() - 1;
    warnings.tell(run.ticker(), faults, tick);
    for (std::size_t i = 0; i < observers.size(); ++i) {
      observers[i].observe(observers[i].user, this, tick, seconds, status);
    }
  }

  const double rate;   // ticks per second
  std::uint64_t seed;  // of the last restart
  const bool is_real, fails_on_fault;
  std::shared_ptr<const lockstep::host::Program> program;
  std::optional<lockstep::host::embedding::NodeCalls> node_calls;  // the end of a run is told
  const lockstep::host::LeafLog log;                               // the program's
  lockstep::host::embedding::RunLimitsWatch limits;
  lockstep::host::embedding::RunWatchers watchers;
  lockstep::host::embedding::RunProperties properties;
  lockstep::host::Warnings warnings;
  std::unique_ptr<lockstep::host::KeptRun> kept;  // null: it is not kept in a file
  std::string not_kept;                           // why not any more
  std::uint32_t first_tick = 0;                   // by the number of RunState
  std::vector<ObserverCall> observers;
  lockstep::host::Nanoseconds last{0};  // when it was ticked last
  bool is_busy = false;                 // in a call that calls back
  const lockstep::host::OwnProcess process;
  std::string text;                  // of the last get_text or fault
  std::vector<lockstep_text> texts;  // of the last get_text_list
  lockstep::host::Run run;           // last: when it ends, it calls back what uses all of the above
};

namespace lockstep::host::embedding {

inline const Tree& tree_of(const lockstep_run& run) {
  return run.program->runnable.tree;
}

// A child that fork has made has the memory of the run, but the threads and processes of its leaves
// are its parent's.
inline bool is_own(const lockstep_run& run) {
  return run.process.is_this() || fail("the run belongs to the process that has made it");
}

// A call that ticks, halts or restarts. What it calls back, a leaf, an observer or who gets the
// log, must not do that again: it would meet a tick that is not over.
class Busy {
 public:
  explicit Busy(lockstep_run& run) : run_(run) {
    if (!is_own(run)) return;
    is_first_ = !std::exchange(run.is_busy, true);
    if (!is_first_) fail("the run is in use: what it calls back cannot tick, halt or restart it");
  }
  ~Busy() {
    if (is_first_) run_.is_busy = false;
  }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

  bool is_refused() const { return !is_first_; }

 private:
  lockstep_run& run_;
  bool is_first_ = false;
};

// A reason, and what to do. Returns false.
bool refuse(const Problem& wrong);

// "Main/arm: threw an exception: …"
std::string fault_text(const lockstep_run& run, const Fault& fault);

// While its entries are used.
inline EntriesLock* lock_of(lockstep_run* run) {
  return run == nullptr ? nullptr : run->run.blackboard().lock.get();
}

}  // namespace lockstep::host::embedding

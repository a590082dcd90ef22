// The object behind lockstep_run. Only within embedding/.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "embedding/handles.h"
#include "embedding/node_calls.h"
#include "embedding/run_limits.h"
#include "embedding/run_properties.h"
#include "embedding/run_watchers.h"
#include "embedding/warnings.h"
#include "run/run.h"

struct lockstep_run {
  struct ObserverCall {
    lockstep_observe observe;
    void* user;
  };

  lockstep_run(std::shared_ptr<const lockstep::host::Program> loaded,
               lockstep::host::RunOptions options, lockstep::host::embedding::RunLimits given)
      : rate(options.rate),
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
        run(program->runnable.tree, with_own(std::move(options))),
        warnings(program->runnable.tree, leaf_log()) {}
  ~lockstep_run() { end(); }

  // Lines of leaves go to the program, and to those who watch.
  lockstep::host::LeafLog leaf_log() {
    return [this](std::string_view who, lockstep_log_level level, std::string_view line) {
      watchers.log(who, lockstep::host::name_of(level), line);
      if (log) log(who, level, line);
    };
  }
  lockstep::host::RunOptions with_own(lockstep::host::RunOptions options) {
    options.log = leaf_log();
    options.watch = limits.leaf_watch();
    return options;
  }
  // The end of what is watched.
  void end() {
    if (watchers.empty() || !process.is_this()) return;
    run.halt();
    watchers.end(run.ticker(), last);
  }

  void notify(double seconds, lockstep_status status,
              std::span<const lockstep::host::Fault> faults) {
    const std::uint64_t tick = run.ticker().tick_number() - 1;
    warnings.tell(run.ticker(), faults, tick);
    for (std::size_t i = 0; i < observers.size(); ++i) {
      observers[i].observe(observers[i].user, this, tick, seconds, status);
    }
  }

  const double rate;  // ticks per second
  std::shared_ptr<const lockstep::host::Program> program;
  std::optional<lockstep::host::embedding::NodeCalls> node_calls;  // the end of a run is told
  const lockstep::host::LeafLog log;                               // the program's
  lockstep::host::embedding::RunLimitsWatch limits;
  lockstep::host::embedding::RunWatchers watchers;
  lockstep::host::embedding::RunProperties properties;
  lockstep::host::Run run;
  lockstep::host::Warnings warnings;
  std::vector<ObserverCall> observers;
  lockstep::host::Nanoseconds last{0};  // when it was ticked last
  bool is_busy = false;                 // in a call that calls back
  const lockstep::host::OwnProcess process;
  std::string text;                  // of the last get_text or fault
  std::vector<lockstep_text> texts;  // of the last get_text_list
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

// While its entries are used.
inline EntriesLock* lock_of(lockstep_run* run) {
  return run == nullptr ? nullptr : run->run.blackboard().lock.get();
}

}  // namespace lockstep::host::embedding

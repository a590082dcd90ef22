// lockstep_run: ticks, states of nodes, and the fixed-rate loop.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "embedding/groot.h"
#include "embedding/run_handle.h"
#include "engine/node_kind.h"
#include "leaves/plugin/contract/boards.h"
#include "run/loop.h"
#include "run/shape_of.h"

namespace lockstep::host::embedding {

bool refuse(const Problem& wrong) {
  return fail(wrong.hint.empty() ? wrong.message
                                 : fmt::format("{}: {}", wrong.message, wrong.hint));
}

std::string fault_text(const lockstep_run& run, const Fault& fault) {
  return fmt::format("{}: {}", run.program->texts().paths[fault.node], fault.message);
}

namespace {

bool has_processes(const lockstep_project& project) {
  return std::ranges::any_of(project.plugins->list(), &PluginSet::Info::isolated);
}

bool may_be_watched(lockstep_run& run) {
  if (!is_own(run)) return false;
  if (run.is_busy) return fail("the run is in use: it is watched from its first tick on");
  return run.is_new() ||
         fail("the run has been ticked already: it is watched from its first tick on");
}

std::optional<Nanoseconds> time_from(double seconds) {
  constexpr double kMost = 9e9;  // in nanoseconds it must fit 64 bits
  if (!(seconds >= 0 && seconds <= kMost)) return std::nullopt;
  return from_seconds(seconds);
}

class Observing final : public Observer {
 public:
  explicit Observing(lockstep_run& run) : run_(run) {}
  void after_tick(const Moment&, const TickReport& report) override {
    const InLeaf scope(lock_of(&run_));
    run_.notify(to_seconds(report.time), static_cast<lockstep_status>(report.status),
                report.faults);
  }

 private:
  lockstep_run& run_;
};

int32_t reason_of(StopReason reason) {
  switch (reason) {
    case StopReason::Completed:
      return LOCKSTEP_COMPLETED;
    case StopReason::Fault:
      return LOCKSTEP_FAULT;
    case StopReason::Timeout:
      return LOCKSTEP_TIMEOUT;
    case StopReason::MaxTicks:
      return LOCKSTEP_MAX_TICKS;
    case StopReason::Overrun:
      return LOCKSTEP_OVERRUN;
    case StopReason::Stopped:
    case StopReason::Signal:
    case StopReason::Recording:
    case StopReason::Property:
      break;
  }
  return LOCKSTEP_STOPPED;
}

// Nothing: an option is wrong.
std::optional<RunLimits> limits_of(const lockstep_run_options& options) {
  const auto budget = time_from(options.tick_budget), hang = time_from(options.hang_limit);
  if (!budget) fail("tick_budget is not a number of seconds");
  if (budget && !hang) fail("hang_limit is not a number of seconds");
  if (!budget || !hang) return std::nullopt;
  RunLimits limits;
  if (*budget > Nanoseconds(0)) limits.budget = budget;
  if (options.hang == nullptr) return limits;
  limits.hang_limit = *hang;
  limits.on_hang = [hang = options.hang, user = options.user](
                       const std::string& who, const char* function, double seconds) {
    hang(user, who.c_str(), function, seconds);
  };
  return limits;
}

bool run_loop(lockstep_run& run, const lockstep_loop_options& given, RunEnd& end) {
  if (given.overrun < LOCKSTEP_OVERRUN_SKIP || given.overrun > LOCKSTEP_OVERRUN_FAIL) {
    return fail("overrun is not one of the LOCKSTEP_OVERRUN_ constants");
  }
  if (!run.is_new()) {
    return fail("the run has been ticked already: restart it before the loop");
  }
  LoopOptions options;
  options.rate = run.rate;
  options.overrun = static_cast<OverrunPolicy>(given.overrun);
  if (given.max_ticks != 0) options.max_ticks = given.max_ticks;
  if (given.timeout != 0) {
    options.timeout = time_from(given.timeout);
    if (!options.timeout) return fail("the timeout is not a number of seconds");
  }
  if (given.virtual_clock && !options.max_ticks) options.max_ticks = kMostVirtualTicks;
  if (given.stop != nullptr) {
    options.stopped = [&given] { return given.stop(given.user); };
  }
  if (run.kept != nullptr) {
    options.checkpoints = run.kept->writer();
    options.before = run.kept->before();
  }
  WallClock wall;
  VirtualClock virtual_clock;
  Observing observing(run);
  std::vector<Observer*> observers(run.watchers.observers().begin(),
                                   run.watchers.observers().end());
  observers.push_back(&observing);
  run.limits.watch_this_thread();
  Clock& clock = given.virtual_clock ? static_cast<Clock&>(virtual_clock) : wall;
  end = lockstep::host::run_loop(run.run, clock, options, observers);
  run.watchers.end_with_loop();
  run.watchers.end(run.run.ticker(), end.last);
  if (run.kept != nullptr) run.kept->end(end.ticks, end.last);
  run.forget_kept();
  return true;
}

}  // namespace
}  // namespace lockstep::host::embedding

using namespace lockstep::host;
using namespace lockstep::host::embedding;

lockstep_run* lockstep_run_new(lockstep_project* project, const lockstep_run_options* given) {
  return guarded([&]() -> lockstep_run* {
    if (project == nullptr || !project->program) {
      fail("the project has not been loaded");
      return nullptr;
    }
    if (!project->process.is_this() && has_processes(*project)) {
      fail(
          "the project has plugins with a process of their own, which belongs to the process that "
          "has loaded it");
      return nullptr;
    }
    const lockstep_run_options options = read_struct(given);
    RunOptions run_options{.seed = options.seed};
    if (options.tick_period != 0) {
      const auto period = time_from(options.tick_period);
      if (!period || period->count() < 1) {
        fail("tick_period is not a number of seconds");
        return nullptr;
      }
      run_options.rate = 1 / options.tick_period;
    }
    run_options.virtual_time = options.virtual_time;
    if (options.on_fault == LOCKSTEP_ON_FAULT_FAIL) run_options.on_fault = FaultPolicy::Fail;
    run_options.may_wake = true;
    if (options.wake != nullptr) {
      run_options.on_wake = [wake = options.wake, user = options.user] { wake(user); };
    }
    if (options.log != nullptr) {
      run_options.log = [log = options.log, user = options.user](
                            std::string_view who, lockstep_log_level level, std::string_view text) {
        log(user, std::string(who).c_str(), level, std::string(text).c_str());
      };
    }
    if (options.prepare != nullptr) {
      run_options.prepare = [prepare = options.prepare, user = options.user](BoardsOfRun& boards) {
        lockstep_board* const main = boards.retain(0);
        prepare(user, main);
        boards.release();
      };
    }
    auto limits = limits_of(options);
    if (!limits) return nullptr;
    auto run = std::make_unique<lockstep_run>(project->program, std::move(run_options),
                                              std::move(*limits));
    if (run->run.fault() != nullptr) {
      fail(fault_text(*run, *run->run.fault()));
      return nullptr;
    }
    return run.release();
  });
}

void lockstep_run_free(lockstep_run* run) {
  shielded([&] {
    if (run == nullptr || !run->process.is_this()) return true;
    if (std::exchange(run->is_busy, true)) return fail("the run is in use: it is not freed");
    delete run;
    return true;
  });
}

bool lockstep_run_restart(lockstep_run* run, uint64_t seed) {
  return guarded([&] {
    if (run == nullptr) return fail("an argument is NULL");
    const Busy busy(*run);
    if (busy.is_refused()) return false;
    run->end();
    run->last = Nanoseconds(0);
    run->first_tick = 0;
    run->seed = seed;
    run->not_kept.clear();
    run->warnings.begin_again();
    if (!run->properties.empty()) {
      run->properties.begin_again();
      run->watchers.watch(run->properties);
    }
    run->run.restart(seed);
    return run->run.fault() == nullptr || fail(fault_text(*run, *run->run.fault()));
  });
}

namespace lockstep::host::embedding {
namespace {

lockstep_status tick(lockstep_run* run, double seconds, bool exactly_once) {
  lockstep_status status = LOCKSTEP_RUNNING;
  const bool is_good = guarded([&] {
    const auto time = time_from(seconds);
    if (run == nullptr) return fail("an argument is NULL");
    if (!time) return fail("the time is not a number of seconds");
    if (*time < run->last) return fail("the time is before that of the last tick");
    const Busy busy(*run);
    if (busy.is_refused()) return false;
    run->last = *time;
    if (run->run.fault() != nullptr) return true;  // a leaf may be missing
    run->limits.watch_this_thread();
    Ticker& ticker = run->run.ticker();
    if (!run->watchers.empty()) {
      run->run.set_now(*time);
      run->watchers.before_tick(ticker, *time);
    }
    if (run->kept != nullptr) run->kept->before_tick(ticker);
    status = static_cast<lockstep_status>(exactly_once ? run->run.tick_exactly_once(*time)
                                                       : run->run.tick(*time));
    const std::vector<Fault> faults = ticker.take_tolerated();
    if (!run->watchers.empty()) {
      run->watchers.after_tick(ticker, {.tick = ticker.tick_number() - 1,
                                        .time = *time,
                                        .status = static_cast<Status>(status),
                                        .faults = faults});
    }
    run->notify(seconds, status, faults);
    if (run->kept != nullptr) {
      const InEngine scope(lock_of(run));
      run->kept->after_tick(ticker, static_cast<Status>(status));
    }
    return true;
  });
  if (is_good) forget_error();  // of an observer
  return status;
}

}  // namespace
}  // namespace lockstep::host::embedding

lockstep_status lockstep_run_tick(lockstep_run* run, double seconds) {
  return tick(run, seconds, false);
}

lockstep_status lockstep_run_tick_once(lockstep_run* run, double seconds) {
  return tick(run, seconds, true);
}

void lockstep_run_halt(lockstep_run* run) {
  guarded([&] {
    if (run == nullptr) return true;
    const Busy busy(*run);
    if (busy.is_refused()) return false;
    run->run.halt();
    Ticker& ticker = run->run.ticker();
    run->watchers.halted(ticker, run->last);
    if (run->kept != nullptr) run->kept->halted(ticker);
    run->warnings.tell(ticker, ticker.take_tolerated(), ticker.tick_number());
    return true;
  });
}

bool lockstep_run_recover(lockstep_run* run) {
  return guarded([&] {
    if (run == nullptr) return fail("an argument is NULL");
    const Busy busy(*run);
    if (busy.is_refused()) return false;
    const Fault fault = run->run.fault() == nullptr ? Fault() : *run->run.fault();
    if (!run->run.recover()) return fail(fault_text(*run, fault));
    if (!fault.message.empty()) {
      run->leaf_log()(tree_of(*run).path(fault.node), LOCKSTEP_LOG_WARNING,
                      fault.message + "; the run continues");
    }
    Ticker& ticker = run->run.ticker();
    if (run->kept != nullptr) run->kept->halted(ticker);
    run->warnings.tell(ticker, ticker.take_tolerated(), ticker.tick_number());
    return true;
  });
}

const char* lockstep_run_fault(lockstep_run* run, uint32_t* node) {
  return shielded([&]() -> const char* {
    const Fault* const fault = run == nullptr ? nullptr : run->run.fault();
    if (fault == nullptr) return nullptr;
    if (node != nullptr) *node = fault->node;
    run->text = fault_text(*run, *fault);
    return run->text.c_str();
  });
}

bool lockstep_run_node(lockstep_run* run, uint32_t node, lockstep_node_state* state) {
  return guarded([&] {
    if (run == nullptr || node >= tree_of(*run).nodes.size()) return fail("no such node");
    if (!is_own(*run)) return false;  // leaves are asked
    Ticker& ticker = run->run.ticker();
    const bool is_good = write_struct({.struct_size = 0,
                                       .status = static_cast<lockstep_status>(ticker.status(node)),
                                       .progress = ticker.progress(node),
                                       .held = ticker.held(node),
                                       .ticked = ticker.ticked(node)},
                                      state);
    run->warnings.tell(ticker, {}, 0);
    return is_good;
  });
}

const char* lockstep_run_question(lockstep_run* run, uint32_t node) {
  return guarded([&]() -> const char* {
    if (run == nullptr || node >= tree_of(*run).nodes.size()) {
      fail("no such node");
      return nullptr;
    }
    Ticker& ticker = run->run.ticker();
    const bool asks = tree_of(*run).nodes[node].kind->answer != nullptr;
    if (asks && ticker.status(node) == Status::Running) {
      const auto found = std::ranges::find(ticker.reasons(), node, &Reason::node);
      if (found != ticker.reasons().end()) return (run->text = found->text).c_str();
    }
    fail("the node asks nothing");
    return nullptr;
  });
}

bool lockstep_run_answer(lockstep_run* run, uint32_t node, const char* answer, const char* who) {
  return guarded([&] {
    if (run == nullptr || node >= tree_of(*run).nodes.size()) return fail("no such node");
    if (answer == nullptr) return fail("an argument is NULL");
    if (!is_own(*run)) return false;
    const auto question = question_of(tree_of(*run), node);
    if (!question) return fail("the node asks nothing");
    const auto option = std::ranges::find(question->options, std::string_view(answer));
    if (option == question->options.end()) {
      return fail(fmt::format("'{}' is no answer to '{}'", answer, tree_of(*run).path(node)));
    }
    Ticker& ticker = run->run.ticker();
    const auto place = static_cast<std::uint32_t>(option - question->options.begin());
    if (!ticker.answer(node, {place, answer, who == nullptr ? "program" : who},
                       ticker.tick_number())) {
      return fail("the node asks nothing");
    }
    if (run->kept != nullptr) {
      const InEngine scope(lock_of(run));
      run->kept->between_ticks(ticker);
    }
    return true;
  });
}

lockstep_board* lockstep_run_board(lockstep_run* run, uint32_t index) {
  return guarded([&]() -> lockstep_board* {
    BoardsOfRun* const boards = run == nullptr ? nullptr : run->run.boards();
    lockstep_board* const board = boards == nullptr ? nullptr : boards->retain(index);
    if (board == nullptr) fail("the run has no such board: see lockstep_project_open_entries");
    return board;
  });
}

const lockstep_boards* lockstep_boards_table(void) {
  return &boards_table();
}

void lockstep_run_wake(lockstep_run* run) {
  if (run != nullptr) run->run.wake();
}

bool lockstep_run_observe(lockstep_run* run, lockstep_observe observe, void* user) {
  return guarded([&] {
    if (run == nullptr) return fail("an argument is NULL");
    if (observe != nullptr) {
      run->observers.push_back({observe, user});
    } else {
      std::erase_if(run->observers, [&](const auto& it) { return it.user == user; });
    }
    return true;
  });
}

bool lockstep_run_watch_nodes(lockstep_run* run, const uint32_t* nodes, size_t count,
                              lockstep_watch_node watch, void* user) {
  return guarded([&] {
    if (run == nullptr || (nodes == nullptr && count != 0)) return fail("an argument is NULL");
    if (!is_own(*run)) return false;
    const std::span<const uint32_t> all(nodes, count);
    // A group is beside the tree: its nodes have no events.
    const NodeIndex end = tree_of(*run).nodes[0].end;
    if (std::ranges::any_of(all, [end](uint32_t it) { return it >= end; })) {
      return fail("no such node in the tree of the root");
    }
    if (!run->node_calls) run->node_calls.emplace(*run, run->run.ticker());
    run->node_calls->set(watch, user);
    run->run.ticker().watch_nodes(all, watch == nullptr ? nullptr : &*run->node_calls);
    return true;
  });
}

bool lockstep_run_record(lockstep_run* run, const char* file) {
  return guarded([&] {
    if (run == nullptr || file == nullptr) return fail("an argument is NULL");
    if (!may_be_watched(*run)) return false;
    const auto wrong = run->watchers.record(file, [run](const std::string& error) {
      run->leaf_log()("lockstep", LOCKSTEP_LOG_WARNING, error);
    });
    return !wrong || refuse(*wrong);
  });
}

void lockstep_flush_recordings(void) {
  AppendFile::emergency_flush();
}

const char* lockstep_run_monitor(lockstep_run* run, const char* address) {
  return guarded([&]() -> const char* {
    if (run == nullptr) fail("an argument is NULL");
    if (run == nullptr || !is_text("the address", address) || !may_be_watched(*run)) return nullptr;
    const auto link = run->watchers.monitor(address);
    if (!link) refuse(link.error());
    if (!link) return nullptr;
    run->text = *link;
    return run->text.c_str();
  });
}

bool lockstep_run_groot2(lockstep_run* run, const char* address) {
  return guarded([&] {
    if (run == nullptr) return fail("an argument is NULL");
    if (!is_own(*run)) return false;
    if (run->is_busy) return fail("the run is in use: it is shown between two ticks");
    Ticker& ticker = run->run.ticker();
    if (address == nullptr) {
      run->watchers.show_groot(nullptr, ticker);
      return true;
    }
    if (!is_text("the address", address)) return false;
    if (run->watchers.has_groot()) return fail("the run is shown in Groot2 already");
    const auto& shown = run->program->groot;
    if (shown == nullptr) {
      return fail(
          "nothing is kept for Groot2: call lockstep_project_show_groot2 before the tree is "
          "loaded; it can number 65534 nodes");
    }
    auto observer = show_groot(tree_of(*run), *shown, address);
    if (!observer) return refuse(observer.error());
    run->watchers.show_groot(std::move(*observer), ticker);
    return true;
  });
}

bool lockstep_run_loop(lockstep_run* run, const lockstep_loop_options* given,
                       lockstep_loop_result* result) {
  return guarded([&] {
    if (run == nullptr) return fail("an argument is NULL");
    const Busy busy(*run);
    if (busy.is_refused()) return false;
    RunEnd end;
    if (!embedding::run_loop(*run, read_struct(given), end)) return false;
    forget_error();  // of an observer
    return result == nullptr || write_struct({.struct_size = 0,
                                              .reason = reason_of(end.reason),
                                              .status = static_cast<lockstep_status>(end.status),
                                              .ticks = end.ticks,
                                              .overruns = end.overruns,
                                              .seconds = to_seconds(end.time)},
                                             result);
  });
}

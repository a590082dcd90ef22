#include "runtime/run.h"

#include <fmt/format.h>

namespace lockstep::host {

Run::Run(const Tree& tree, const RunOptions& options)
    : blackboard_(tree),
      exactly_once_(options.exactly_once),
      time_{.now = Nanoseconds(0),
            .period = options.period,
            .thread = this_thread_id(),
            .workers = options.virtual_time ? &workers_ : nullptr,
            .processes = options.virtual_time ? nullptr : &processes_,
            .end_budget = options.end_budget},
      watch_(options.watch),
      leaves_(tree, blackboard_, time_, options.seed, options.log),
      ticker_(tree, leaves_.slots(), blackboard_, options.on_fault, options.watch) {
  leaves_.set_ticker(ticker_);
}

// The ticker has entries that leaves have made by name.
Run::~Run() {
  halt();
  leaves_.destroy_all();
}

void Run::halt() {
  adopt_thread();
  ticker_.halt_all();
}

// A run may be ticked by one thread now and by another later. Written only then, for the sake of
// threads that have no business to look.
void Run::adopt_thread() {
  if (time_.thread != this_thread_id()) time_.thread = this_thread_id();
}

void Run::restart(std::uint64_t seed) {
  halt();
  leaves_.destroy_all();
  blackboard_.reset(ticker_.tree());
  time_.now = Nanoseconds(0);
  leaves_.create_all(seed);
  ticker_.reset();
}

void Run::set_now(Nanoseconds now) {
  adopt_thread();
  time_.now = now;
  ticker_.set_now(now);
  workers_.give_turns(now);
}

Status Run::tick(Nanoseconds now) {
  set_now(now);
  look_at_processes();
  Status status = ticker_.tick_root(now);
  if (ticker_.is_asked()) status = tick_again_if_asked(status);
  workers_.give_turns(now);
  return status;
}

Status Run::tick_again_if_asked(Status status) {
  for (int count = 1;; ++count) {
    const auto node = ticker_.take_request();
    if (!node || exactly_once_ || status != Status::Running || ticker_.faulted()) return status;
    if (count == kMostTicksAtOnce) {
      ticker_.set_fault(*node, fmt::format("asked for another tick {} times in one period: what it "
                                           "repeats completes at once",
                                           count));
      return status;
    }
    status = ticker_.tick_root_again();
  }
}

const Fault* Run::fault() const {
  if (leaves_.fault()) return &*leaves_.fault();
  return ticker_.fault();
}

}  // namespace lockstep::host

#include "run/run.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/tree.h"

namespace lockstep::host {
namespace {

bool has_wakers(const Tree& tree) {
  return std::ranges::any_of(tree.leaves, [](const LeafNode& it) {
    return it.type->leaf != nullptr && (it.type->leaf->flags & LOCKSTEP_WAKES) != 0;
  });
}

}  // namespace

Run::Run(const Tree& tree, const RunOptions& options)
    : blackboard_(tree),
      boards_(make_boards(tree, blackboard_)),
      prepare_(options.prepare),
      wake_up_(options.on_wake),
      may_wake_(options.may_wake || has_wakers(tree)),
      exactly_once_(options.exactly_once),
      time_{.now = Nanoseconds(0),
            .period = deadline_of(1, options.rate),
            .thread = this_thread_id(),
            .workers = options.virtual_time ? &workers_ : nullptr,
            .processes = options.virtual_time ? nullptr : &processes_,
            .end_budget = options.end_budget,
            .wake_up = options.virtual_time ? nullptr : &wake_up_,
            .budget = &budget_},
      watch_(options.watch),
      leaves_((prepare(), tree), blackboard_, time_, options.seed, options.log, boards_.get()),
      ticker_(tree, leaves_.slots(), blackboard_, options.on_fault, options.watch) {
  leaves_.set_node_context(ticker_);
  ticker_.set_deadlines(Deadlines(options.rate));
}

void Run::prepare() {
  if (boards_ != nullptr && prepare_) prepare_(*boards_);
}

Run::~Run() {
  halt();
  leaves_.destroy_all();
}

void Run::halt() {
  adopt_thread();
  ticker_.halt_all();
}

bool Run::recover() {
  if (leaves_.fault()) return false;
  adopt_thread();
  ticker_.recover();
  return true;
}

// A run may be ticked by one thread now and by another later. Written only then, for the sake of
// threads that have no business to look.
void Run::adopt_thread() {
  if (time_.thread != this_thread_id()) time_.thread = this_thread_id();
}

void Run::restart(std::uint64_t seed) {
  halt();
  leaves_.destroy_all();
  {
    const InEngine scope(blackboard_.lock.get());
    blackboard_.reset(ticker_.tree());
    if (boards_ != nullptr) boards_->begin_again();
  }
  prepare();
  time_.now = Nanoseconds(0);
  leaves_.create_all(seed);
  ticker_.reset();
}

void Run::set_now(Nanoseconds now) {
  adopt_thread();
  time_.now = now;
  ticker_.set_now(now);
  give_turns();
}

Status Run::tick(bool exactly_once) {
  look_at_processes();
  Status status = ticker_.tick_root();
  if (ticker_.is_asked()) status = tick_again_if_asked(status, exactly_once);
  give_turns();
  return status;
}

Status Run::tick_again_if_asked(Status status, bool exactly_once) {
  for (int count = 1;; ++count) {
    const auto node = ticker_.take_request();
    if (node && exactly_once && !exactly_once_) wake_up_.wake();  // for who waits after this tick
    if (!node || exactly_once || status != Status::Running || ticker_.faulted()) return status;
    if (count == kMostTicksAtOnce) {
      ticker_.set_fault(
          *node,
          fmt::format(
              "requested another tick {} times in one period: what it repeats completes at once",
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

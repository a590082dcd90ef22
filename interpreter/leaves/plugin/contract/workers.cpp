#include "leaves/plugin/contract/workers.h"

#include <algorithm>

#include "leaves/plugin/contract/host.h"

// All members are guarded by the mutex of the set.
struct lockstep_worker {
  lockstep::host::Workers& set;
  const lockstep::host::CallSite& site;
  std::condition_variable turn = {};
  double since = 0, until = 0;  // it began to wait, and for this time
  bool has_turn = false;
  bool is_woken = true;  // its first turn waits for nothing
  bool has_ended = false;

  // Rounding brings no time that is still to come into the tick that asked for it.
  bool has_waited(double now) const {
    constexpr double kRounding = 1e-9;  // of a sum of durations
    return until <= (now > since ? now + kRounding : now);
  }
  bool is_due(double now) const { return !has_ended && (is_woken || has_waited(now)); }
};

namespace lockstep::host {

Workers::Workers() = default;
Workers::~Workers() = default;

lockstep_worker* Workers::begin(const CallSite& site, double now) {
  const Lock lock(mutex_);
  now_ = now;
  all_.push_back(std::unique_ptr<lockstep_worker>(new lockstep_worker{*this, site}));
  return all_.back().get();
}

void Workers::give_all(double now) {
  for (std::size_t i = 0; i < all_.size(); ++i) {
    bool is_due = false;
    {
      const Lock lock(mutex_);
      now_ = now;
      is_due = all_[i]->is_due(now);
    }
    if (is_due) give_turn(*all_[i]);
  }
}

// The mark names the leaf when its worker blocks elsewhere, and the thread that does.
void Workers::give_turn(lockstep_worker& worker) {
  const MarkedCall mark(worker.site, PluginFunction::Run);
  Lock lock(mutex_);
  waiting_ = &CallMark::this_thread();
  worker.has_turn = true;
  worker.is_woken = false;
  worker.turn.notify_one();
  while (worker.has_turn) lock.wait(turn_over_);
  waiting_->set_worker(0);
}

void Workers::await_turn(lockstep_worker& worker, Lock& lock) {
  while (!worker.has_turn) lock.wait(worker.turn);
  waiting_->set_worker(pthread_self());
}

void Workers::finish(lockstep_worker* worker) {
  Workers& set = worker->set;
  const auto has_ended = [&] {
    const Lock lock(set.mutex_);
    return worker->has_ended;
  };
  while (!has_ended()) set.give_turn(*worker);
  std::erase_if(set.all_, [&](const auto& it) { return it.get() == worker; });
}

void Workers::start(lockstep_worker* worker) {
  Workers& set = worker->set;
  Lock lock(set.mutex_);
  set.await_turn(*worker, lock);
}

bool Workers::wait(lockstep_worker* worker, double until) {
  Workers& set = worker->set;
  Lock lock(set.mutex_);
  worker->since = set.now_;
  worker->until = until;
  worker->has_turn = false;
  set.turn_over_.notify_one();
  set.await_turn(*worker, lock);
  return worker->has_waited(set.now_);
}

void Workers::end(lockstep_worker* worker) {
  Workers& set = worker->set;
  const Lock lock(set.mutex_);
  worker->has_turn = false;
  worker->has_ended = true;
  set.turn_over_.notify_one();
}

double Workers::now(lockstep_worker* worker) {
  const Lock lock(worker->set.mutex_);
  return worker->set.now_;
}

void Workers::wake(lockstep_worker* worker) {
  const Lock lock(worker->set.mutex_);
  worker->is_woken = true;
}

namespace {

lockstep_worker* begin(const lockstep_caller* caller) {
  Workers* const workers = caller->time->workers;
  if (workers == nullptr || caller->is_foreign() || caller->slot->site == nullptr) return nullptr;
  try {
    return workers->begin(*caller->slot->site, to_seconds(caller->time->now));
  } catch (const std::exception&) {
    host_table().set_error(caller, "there is no memory for a worker");
    return nullptr;
  }
}

}  // namespace

const lockstep_workers& workers_table() {
  static constexpr lockstep_workers kTable{.struct_size = sizeof(lockstep_workers),
                                           .begin = begin,
                                           .finish = Workers::finish,
                                           .start = Workers::start,
                                           .wait = Workers::wait,
                                           .end = Workers::end,
                                           .now = Workers::now,
                                           .wake = Workers::wake};
  return kTable;
}

}  // namespace lockstep::host

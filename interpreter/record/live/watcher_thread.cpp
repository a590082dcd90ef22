#include "record/live/watcher_thread.h"

#include <sys/eventfd.h>

#include <utility>

#include "base/system/own_thread.h"

namespace lockstep::host {

WatcherThread::WatcherThread() : wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

void WatcherThread::start(std::function<void()> watch) {
  thread_ = own_thread(std::move(watch));
}

void WatcherThread::wake() const {
  eventfd_write(wake_.number(), 1);
}

void WatcherThread::ask_to_stop() {
  stopping_.store(true, std::memory_order_release);
  wake();
}

void WatcherThread::stop() {
  if (!is_started()) return;
  ask_to_stop();
  join();
}

void WatcherThread::forget_wakes() const {
  eventfd_t rung = 0;
  eventfd_read(wake_.number(), &rung);
}

}  // namespace lockstep::host

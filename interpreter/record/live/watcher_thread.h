// The thread of one who watches a run: it sleeps in poll() until the tick thread, or anybody else,
// wakes it, and ends when it is asked to.
#pragma once

#include <atomic>
#include <functional>
#include <thread>

#include "base/system/file_descriptor.h"

namespace lockstep::host {

class WatcherThread {
 public:
  WatcherThread();

  void start(std::function<void()> watch);
  bool is_started() const { return thread_.joinable(); }
  // From any thread.
  void wake() const;
  void ask_to_stop();
  void join() { thread_.join(); }
  // Both, if it was started.
  void stop();

  // --- for the thread ----------------------------------------------------------------------------

  bool is_stopping() const { return stopping_.load(std::memory_order_acquire); }
  // Can be read from since it was woken.
  int descriptor() const { return wake_.number(); }
  void forget_wakes() const;

 private:
  const FileDescriptor wake_;  // an eventfd
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace lockstep::host

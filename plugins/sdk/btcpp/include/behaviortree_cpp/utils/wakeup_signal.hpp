// Ends a sleep from another thread.
#pragma once

#include <lockstep/duration.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

namespace BT {

class WakeUpSignal {
 public:
  // True: the signal came before the time was over.
  bool waitFor(std::chrono::microseconds time) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, lockstep::bounded(time), [this] { return has_come_; });
    return std::exchange(has_come_, false);
  }
  void emitSignal() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      has_come_ = true;
    }
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool has_come_ = false;
};

}  // namespace BT

// Functions that are called after a while, in a thread. It counts real time: on the virtual clock,
// which does not wait, nodes of a tree want ticks to count.
#pragma once

#include <lockstep/duration.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace BT {

template <class Clock = std::chrono::steady_clock, class Duration = typename Clock::duration>
class TimerQueue {
 public:
  // Whether it was canceled.
  using Handler = std::function<void(bool)>;

  TimerQueue() : thread_([this] { run(); }) {}
  ~TimerQueue() {
    cancelAll();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_over_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }
  TimerQueue(const TimerQueue&) = delete;
  TimerQueue& operator=(const TimerQueue&) = delete;

  // Its number, for cancel.
  std::uint64_t add(std::chrono::milliseconds delay, Handler handler) {
    const std::lock_guard<std::mutex> lock(mutex_);
    timers_.push_back(
        {Clock::now() + lockstep::bounded(delay), ++last_, false, std::move(handler)});
    changed_.notify_all();
    return last_;
  }
  // How many were canceled: 0 when it has been called already.
  std::size_t cancel(std::uint64_t number) {
    return cancel_if([number](const Timer& timer) { return timer.number == number; });
  }
  std::size_t cancelAll() {
    return cancel_if([](const Timer&) { return true; });
  }

 private:
  struct Timer {
    std::chrono::time_point<Clock, Duration> end;
    std::uint64_t number;
    bool is_canceled;
    Handler handler;
  };

  template <class Condition>
  std::size_t cancel_if(Condition condition) {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::size_t count = 0;
    for (Timer& timer : timers_) {
      if (timer.is_canceled || !condition(timer)) continue;
      timer.is_canceled = true;
      timer.end = Clock::now();
      ++count;
    }
    changed_.notify_all();
    return count;
  }

  void run() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (!is_over_ || !timers_.empty()) {
      const auto next =
          std::min_element(timers_.begin(), timers_.end(),
                           [](const Timer& a, const Timer& b) { return a.end < b.end; });
      if (next == timers_.end()) {
        changed_.wait(lock);
      } else if (next->end > Clock::now()) {
        const auto end = next->end;
        changed_.wait_until(lock, end);
      } else {
        const Timer due = std::move(*next);
        timers_.erase(next);
        lock.unlock();
        due.handler(due.is_canceled);
        lock.lock();
      }
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Timer> timers_;
  std::uint64_t last_ = 0;
  bool is_over_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace BT

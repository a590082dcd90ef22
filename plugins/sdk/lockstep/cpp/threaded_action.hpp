// An action whose work blocks: it runs in a separate thread, while the tree continues to tick.
// Included by lockstep/leaf.hpp.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "action.hpp"

namespace lockstep {
inline namespace sdk1 {

namespace detail {
class Worker;
}

// Informs the work about halt and pause, and receives its progress. For the thread of run().
class Token {
 public:
  // The activation has been halted: return soon.
  bool stop_requested() const {
    return locked([this] { return stop_; });
  }
  bool pause_requested() const {
    return locked([this] { return pause_; });
  }

  // Returns at once when not paused, else when resumed or halted. False: halted, return now.
  bool wait_while_paused() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return stop_ || !pause_; });
    return !stop_;
  }

  // A sleep in real time that a halt ends. False: halted, return now.
  template <class Rep, class Period>
  bool sleep_for(std::chrono::duration<Rep, Period> duration) {
    std::unique_lock<std::mutex> lock(mutex_);
    return !changed_.wait_for(lock, duration, [this] { return stop_; });
  }

  void set_progress(double progress) { progress_.store(progress, std::memory_order_relaxed); }

  Token() = default;
  Token(const Token&) = delete;
  Token& operator=(const Token&) = delete;

 private:
  friend class detail::Worker;

  template <class Question>
  bool locked(Question question) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return question();
  }
  void request(bool Token::*what, bool value) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      this->*what = value;
    }
    changed_.notify_all();
  }
  void reset() {
    stop_ = pause_ = false;
    set_progress(0);
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stop_ = false;
  bool pause_ = false;
  std::atomic<double> progress_{0};
};

namespace detail {

// One thread per activation, and its result. All but the work itself belongs to the run's thread.
class Worker {
 public:
  template <class Work>
  void launch(Work work) {
    token_.reset();
    done_.store(false, std::memory_order_relaxed);
    error_ = nullptr;
    thread_ = std::thread([this, work] {
      in_worker = true;
      try {
        result_ = work(token_);
      } catch (...) {
        error_ = std::current_exception();
      }
      done_.store(true, std::memory_order_release);
    });
  }

  // The result is there: take() will not block.
  bool done() const { return done_.load(std::memory_order_acquire); }

  // Waits for the end of the work. Throws what the work has thrown.
  Status take() {
    join();
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    return result_;
  }

  void stop() {
    token_.request(&Token::stop_, true);
    if (thread_.joinable()) take();
  }
  void stop_silently() noexcept {
    token_.request(&Token::stop_, true);
    join();
  }
  void pause(bool value) { token_.request(&Token::pause_, value); }
  double progress() const { return token_.progress_.load(std::memory_order_relaxed); }

 private:
  void join() {
    if (thread_.joinable()) thread_.join();
  }

  std::thread thread_;
  Token token_;
  Status result_ = Status::Failure;
  std::exception_ptr error_;
  std::atomic<bool> done_{false};
};

}  // namespace detail

template <class PortsOfLeaf = NoPorts>
class ThreadedAction : public Action<PortsOfLeaf> {
 public:
  using Status = sdk1::Status;
  static constexpr bool kRealTime = true;

  // In the tree's thread, before run: read the ports here.
  virtual void begin() {}
  // The work, in a separate thread, which ends with it. Returns Success or Failure; after a halt
  // the result does not count. Must return soon after token.stop_requested(): halt waits for it,
  // and the whole tree with halt. May not use ports, time or random numbers.
  virtual Status run(Token& token) = 0;
  // In the tree's thread, after run has returned and was not halted: write the ports here.
  virtual void finish(Status) {}

  void start() final {
    begin();
    worker_.launch([this](Token& token) { return run(token); });
  }
  Status tick() final {
    if (!worker_.done()) return Status::Running;
    const Status result = worker_.take();
    if (result != Status::Success && result != Status::Failure) {
      throw std::logic_error("run() returned neither success nor failure");
    }
    finish(result);
    return result;
  }
  void halt() final { worker_.stop(); }
  void pause() final { worker_.pause(true); }
  void resume() final { worker_.pause(false); }
  double progress() const final { return worker_.progress(); }

 protected:
  ThreadedAction() { this->caller_.has_worker = true; }
  ~ThreadedAction() override { worker_.stop_silently(); }

 private:
  void before_destroy() final { worker_.stop_silently(); }

  detail::Worker worker_;
};

}  // namespace sdk1
}  // namespace lockstep

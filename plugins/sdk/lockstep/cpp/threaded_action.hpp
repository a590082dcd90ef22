// An action whose work blocks: it runs in a separate thread, while the tree continues to tick. On
// the virtual clock the thread takes turns with the ticks, and its sleeps last as long in the run's
// time, so that the run is the same every time.
// Included by lockstep/leaf.hpp.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>

#include "../duration.h"
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

  // Returns at once when not paused, otherwise when resumed or halted. False: halted, return now.
  bool wait_while_paused() {
    if (worker_ != nullptr) {
      const double forever = std::numeric_limits<double>::infinity();
      while (!stop_requested() && pause_requested()) workers_->wait(worker_, forever);
      return !stop_requested();
    }
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return stop_ || !pause_; });
    return !stop_;
  }

  // A sleep that a halt ends, in real time or that of the virtual clock; the longest one is
  // kLongestWait. False: halted, return now.
  template <class Rep, class Period>
  bool sleep_for(std::chrono::duration<Rep, Period> duration) {
    const std::chrono::nanoseconds time = bounded(duration);
    if (worker_ != nullptr) {
      const double end = workers_->now(worker_) + std::chrono::duration<double>(time).count();
      while (!stop_requested() && !workers_->wait(worker_, end)) {  // woken
      }
      return !stop_requested();
    }
    std::unique_lock<std::mutex> lock(mutex_);
    return !changed_.wait_for(lock, time, [this] { return stop_; });
  }

  // On the virtual clock the thread waits here for the next tick; otherwise it continues at once.
  // For work that checks again and again whether it must stop, and does not sleep by the token.
  void yield() {
    if (worker_ != nullptr) workers_->wait(worker_, workers_->now(worker_) + 1e-9);
  }

  // How fast to be, in (0, 1]: set_pace of Action. For a class with kPaces.
  double pace() const { return pace_.load(std::memory_order_relaxed); }

  void set_progress(double progress) { progress_.store(progress, std::memory_order_relaxed); }

  // What the work waits for, until it says something else; "" is nothing.
  void wait(std::string reason) {
    const std::lock_guard<std::mutex> lock(mutex_);
    reason_ = std::move(reason);
    has_reason_.store(!reason_.empty(), std::memory_order_release);
  }
  // At the end of run: `return token.fail("no object at the door");`
  Status fail(std::string reason) {
    wait(std::move(reason));
    is_of_failure_.store(true, std::memory_order_release);
    return Status::Failure;
  }

  Token() = default;
  Token(const Token&) = delete;
  Token& operator=(const Token&) = delete;

 private:
  friend class detail::Worker;

  template <class Question>
  std::invoke_result_t<Question> locked(Question question) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return question();
  }
  void request(bool Token::*what, bool value) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      this->*what = value;
    }
    changed_.notify_all();
    if (worker_ != nullptr) workers_->wake(worker_);
  }
  void reset() {
    stop_ = pause_ = false;
    wait({});
    is_of_failure_.store(false, std::memory_order_relaxed);
    set_progress(0);
    pace_.store(1, std::memory_order_relaxed);
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stop_ = false;
  bool pause_ = false;
  std::atomic<double> progress_{0};
  std::atomic<double> pace_{1};
  std::string reason_;
  std::atomic<bool> has_reason_{false}, is_of_failure_{false};
  // The activation's, on the virtual clock; otherwise null.
  const lockstep_workers* workers_ = nullptr;
  lockstep_worker* worker_ = nullptr;
};

namespace detail {

// One thread per activation, and its result. All but the work itself belongs to the run's thread.
class Worker {
 public:
  // `tell` is called in the thread when the result is there.
  template <class Work>
  void launch(const Caller& caller, Work work) {
    launch(caller, work, [] {});
  }
  template <class Work, class Tell>
  void launch(const Caller& caller, Work work, Tell tell) {
    token_.reset();
    done_.store(false, std::memory_order_relaxed);
    error_ = nullptr;
    begin_turns(caller);
    try {
      thread_ = std::thread([this, work, tell] { live(work, tell); });
    } catch (...) {
      end_turns();
      throw;
    }
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
  void set_pace(double factor) { token_.pace_.store(factor, std::memory_order_relaxed); }
  double progress() const { return token_.progress_.load(std::memory_order_relaxed); }
  // What it has said last; of a result only what it has failed with. Mostly nothing, without a
  // lock.
  std::string reason(bool is_done) const {
    if (is_done && !token_.is_of_failure_.load(std::memory_order_acquire)) return {};
    if (!token_.has_reason_.load(std::memory_order_acquire)) return {};
    return token_.locked([this] { return token_.reason_; });
  }
  // An atomic double that needs no lock is one.
  const double* kept_progress() const { return reinterpret_cast<const double*>(&token_.progress_); }

 private:
  // The whole life of the thread.
  template <class Work, class Tell>
  void live(Work work, Tell tell) {
    in_worker = true;
    lockstep_worker* const worker = token_.worker_;
    if (worker != nullptr) token_.workers_->start(worker);
    try {
      result_ = work(token_);
    } catch (...) {
      error_ = std::current_exception();
    }
    done_.store(true, std::memory_order_release);
    tell();
    if (worker != nullptr) token_.workers_->end(worker);
  }

  void begin_turns(const Caller& caller) {
    const void* const table = caller.host->get_extension(LOCKSTEP_WORKERS);
    if (table == nullptr) return;  // an older host
    token_.workers_ = static_cast<const lockstep_workers*>(table);
    token_.worker_ = token_.workers_->begin(caller.id);
  }
  // For a worker without a thread.
  void end_turns() {
    if (token_.worker_ != nullptr) token_.workers_->end(token_.worker_);
    finish_turns();
  }
  void finish_turns() {
    if (token_.worker_ == nullptr) return;
    token_.workers_->finish(token_.worker_);
    token_.worker_ = nullptr;
  }
  void join() {
    if (!thread_.joinable()) return;
    finish_turns();
    thread_.join();
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
    worker_.launch(this->caller_, [this](Token& token) { return run(token); });
  }
  Status tick() final {
    const bool is_done = worker_.done();
    if (const std::string reason = worker_.reason(is_done); !reason.empty())
      this->say(reason.c_str());
    if (!is_done) return Status::Running;
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
  static constexpr bool kKeepsProgress =
      std::atomic<double>::is_always_lock_free && sizeof(std::atomic<double>) == sizeof(double);
  ThreadedAction() { this->caller_.has_worker = true; }
  ~ThreadedAction() override { worker_.stop_silently(); }

 private:
  friend struct detail::LeafAccess;
  void before_destroy() final { worker_.stop_silently(); }
  void before_pace(double factor) final { worker_.set_pace(factor); }
  const double* kept_progress() const final { return worker_.kept_progress(); }

  detail::Worker worker_;
};

}  // namespace sdk1
}  // namespace lockstep

// The lock of a run's entries, for a run whose leaves or whose program use them from other threads.
// The engine holds it while it ticks and gives it back around each call of a leaf; what a leaf, an
// observer or another thread reads and writes enters it for that time. Other runs have none, and
// nothing is locked.
#pragma once

#include <atomic>
#include <mutex>
#include <utility>

namespace lockstep::host {

class EntriesLock {
 public:
  // As often as one thread likes.
  void enter() {
    if (owner_.load(std::memory_order_relaxed) != self()) {
      mutex_.lock();
      owner_.store(self(), std::memory_order_relaxed);
    }
    ++depth_;
  }
  // False: another thread has it.
  bool try_to_enter() {
    if (owner_.load(std::memory_order_relaxed) != self()) {
      if (!mutex_.try_lock()) return false;
      owner_.store(self(), std::memory_order_relaxed);
    }
    ++depth_;
    return true;
  }
  void leave() {
    if (--depth_ != 0) return;
    owner_.store(nullptr, std::memory_order_relaxed);
    mutex_.unlock();
  }
  // How often this thread has entered it, for take_again; it has not then.
  unsigned give_back() {
    if (owner_.load(std::memory_order_relaxed) != self()) return 0;
    const unsigned depth = std::exchange(depth_, 0);
    owner_.store(nullptr, std::memory_order_relaxed);
    mutex_.unlock();
    return depth;
  }
  void take_again(unsigned depth) {
    if (depth == 0) return;
    enter();
    depth_ = depth;
  }

 private:
  static const void* self() {
    static constinit thread_local char id = 0;
    return &id;
  }

  std::mutex mutex_;
  std::atomic<const void*> owner_ = nullptr;
  unsigned depth_ = 0;  // of the owner
};

// Holds it for the time of its scope; null: nothing.
class InEngine {
 public:
  explicit InEngine(EntriesLock* lock) : lock_(lock) {
    if (lock_ != nullptr) [[unlikely]]
      lock_->enter();
  }
  ~InEngine() {
    if (lock_ != nullptr) [[unlikely]]
      lock_->leave();
  }
  InEngine(const InEngine&) = delete;
  InEngine& operator=(const InEngine&) = delete;

 private:
  EntriesLock* const lock_;
};

// Gives it back for the time of its scope, while code of others runs; null: nothing.
class InLeaf {
 public:
  explicit InLeaf(EntriesLock* lock) : lock_(lock) {
    if (lock_ != nullptr) [[unlikely]]
      depth_ = lock_->give_back();
  }
  ~InLeaf() {
    if (lock_ != nullptr) [[unlikely]]
      lock_->take_again(depth_);
  }
  InLeaf(const InLeaf&) = delete;
  InLeaf& operator=(const InLeaf&) = delete;

 private:
  EntriesLock* const lock_;
  unsigned depth_ = 0;
};

}  // namespace lockstep::host

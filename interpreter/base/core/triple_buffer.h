// Passes the newest of a series of values from one thread to another: neither ever waits, and
// values that were not read are lost. One writer, one reader.
//
// It takes three values: one that the writer fills in, one that the reader looks at, and the newest
// in between, which either of them swaps for its own. With two, the writer would have to wait while
// the reader looks. Example: a terminal draws for 50 ms, in which the tick thread publishes five
// snapshots into the other two; the next take() gives the fifth.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace lockstep::host {

template <class T>
class TripleBuffer {
 public:
  explicit TripleBuffer(const T& value) : slots_{value, value, value} {}

  // Before the threads begin: each of the three values.
  template <class Visit>
  void for_each(Visit visit) {
    for (T& slot : slots_) visit(slot);
  }

  // The writer fills this in, then publishes it; before that, it has an old value.
  T& back() { return slots_[back_]; }
  void publish() { back_ = middle_.exchange(back_ | kFresh, std::memory_order_acq_rel) & kSlot; }

  // The reader: true if a newer value has come, which front() is from then on.
  bool take() {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kSlot;
    return true;
  }
  const T& front() const { return slots_[front_]; }

 private:
  static constexpr std::uint32_t kSlot = 3;
  static constexpr std::uint32_t kFresh = 4;

  std::array<T, 3> slots_;
  std::uint32_t back_ = 0;
  std::atomic<std::uint32_t> middle_{1};
  std::uint32_t front_ = 2;
};

}  // namespace lockstep::host

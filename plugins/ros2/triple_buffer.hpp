// One thread writes values, another reads the newest one. Neither ever waits.
#pragma once

#include <array>
#include <atomic>
#include <memory>

namespace ros2 {

template <class T>
class TripleBuffer {
 public:
  template <class Make>
  explicit TripleBuffer(Make make) : all_{make(), make(), make()} {}

  // For the writer: the next value, which publish() hands over.
  T& back() { return *all_[back_]; }
  void publish() { back_ = middle_.exchange(back_ | kNew) & ~kNew; }

  // For the reader: whether front() is another one than before.
  bool update() {
    if ((middle_.load(std::memory_order_relaxed) & kNew) == 0) return false;
    front_ = middle_.exchange(front_) & ~kNew;
    return true;
  }
  T& front() { return *all_[front_]; }

 private:
  static constexpr unsigned kNew = 4;
  std::array<std::unique_ptr<T>, 3> all_;
  unsigned back_ = 0, front_ = 1;
  std::atomic<unsigned> middle_{2};
};

}  // namespace ros2

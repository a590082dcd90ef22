// A function with a separate stack, which may stop in its middle and go on later.
#pragma once

#include <sys/mman.h>
#include <ucontext.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <new>
#include <utility>

namespace BT::lockstep_detail {

class Coroutine {
 public:
  explicit Coroutine(std::function<void()> work)
      : work_(std::move(work)),
        stack_(mmap(nullptr, kStackSize, PROT_READ | PROT_WRITE,
                    MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK, -1, 0)) {
    if (stack_ == MAP_FAILED) throw std::bad_alloc();
    mprotect(stack_, kGuardSize, PROT_NONE);  // what overflows the stack ends there
    getcontext(&inside_);
    inside_.uc_stack.ss_sp = stack_;
    inside_.uc_stack.ss_size = kStackSize;
    inside_.uc_link = &outside_;
    const auto self = reinterpret_cast<std::uintptr_t>(this);
    makecontext(&inside_, reinterpret_cast<void (*)()>(&run), 2, static_cast<unsigned>(self),
                static_cast<unsigned>(static_cast<std::uint64_t>(self) >> 32u));
  }
  ~Coroutine() { munmap(stack_, kStackSize); }
  Coroutine(const Coroutine&) = delete;
  Coroutine& operator=(const Coroutine&) = delete;

  // Goes on until it yields or ends. True: it has ended.
  bool resume() {
    swapcontext(&outside_, &inside_);
    return has_ended_;
  }
  void yield() { swapcontext(&inside_, &outside_); }
  // Throws what it has thrown, if it has.
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  static constexpr std::size_t kStackSize = std::size_t{256} << 10, kGuardSize = 4096;

  // makecontext passes ints only.
  static void run(unsigned low, unsigned high) {
    const std::uint64_t self = (static_cast<std::uint64_t>(high) << 32u) | low;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): as it was passed
    reinterpret_cast<Coroutine*>(static_cast<std::uintptr_t>(self))->live();
  }
  void live() {
    try {
      work_();
    } catch (...) {
      thrown_ = std::current_exception();
    }
    has_ended_ = true;
  }

  std::function<void()> work_;
  void* stack_;
  ucontext_t outside_{}, inside_{};
  std::exception_ptr thrown_;
  bool has_ended_ = false;
};

}  // namespace BT::lockstep_detail

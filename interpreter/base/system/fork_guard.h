// Distinguishes this process from a child that a plugin has forked. Such a child may continue in
// the plugin's code. When it returns to our code it must end, or it would tick the tree a second
// time.
#pragma once

#include <cstdint>

namespace lockstep::host {

class ForkGuard {
 public:
  // From now on check() calls this function in a forked child. The function must not return.
  static void arm(void (*in_child)());
  // Two loads. Async-signal-safe.
  static bool is_child() { return *alive_ == 0; }
  static void check() {
    if (is_child()) [[unlikely]]
      in_child_();
  }

  // A byte that is set, until it is cleared; in a forked child the kernel clears it. So one look at
  // it says that this process is no child, and whatever its owner lets it say.
  class Byte {
   public:
    // Before arm(), it is of ordinary memory.
    Byte();
    ~Byte();
    Byte(const Byte&) = delete;
    Byte& operator=(const Byte&) = delete;

    // False: there are thousands of others, so the kernel does not clear this one.
    bool is_guarded() const { return byte_ != &own_ || alive_ == &kAlive; }
    bool is_set() const {
#if defined(__SANITIZE_THREAD__)
      return __atomic_load_n(byte_, __ATOMIC_RELAXED) != 0;
#else
      return *byte_ != 0;  // the same in one instruction, around each call of a leaf
#endif
    }
    void set() {
      __atomic_store_n(byte_, 1, __ATOMIC_RELAXED);
    }
    void clear() {
      __atomic_store_n(byte_, 0, __ATOMIC_RELAXED);
    }  // from any thread

   private:
    std::uint8_t own_ = 1;
    std::uint8_t* byte_;
  };

 private:
  static constexpr unsigned char kAlive = 1;
  // In memory that the kernel clears in every forked child.
  static constinit inline const volatile unsigned char* alive_ = &kAlive;
  using InChild = void (*)();
  static constinit inline InChild in_child_ = nullptr;
};

}  // namespace lockstep::host

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
    bool is_set() const { return *byte_ != 0; }
    void set() { *byte_ = 1; }
    void clear() { *byte_ = 0; }

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

// Distinguishes this process from a child that a plugin has forked. Such a child may continue in
// the plugin's code. When it returns to our code it must end, or it would tick the tree a second
// time.
#pragma once

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

 private:
  static constexpr unsigned char kAlive = 1;
  // In memory that the kernel clears in every forked child.
  static constinit inline const volatile unsigned char* alive_ = &kAlive;
  using InChild = void (*)();
  static constinit inline InChild in_child_ = nullptr;
};

}  // namespace lockstep::host

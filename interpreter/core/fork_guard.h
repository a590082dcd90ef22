// Tells this process from one that a plugin has forked off it. Such a child may run on in the
// plugin's code; when it comes back into ours it must end, or it would tick the tree once more.
#pragma once

namespace lockstep {

class ForkGuard {
 public:
  // From now on a child of this process is one that was forked off. What check() calls there must
  // not return.
  static void arm(void (*in_child)());
  // Two loads. Async-signal-safe.
  static bool is_child() { return *alive_ == 0; }
  static void check() {
    if (is_child()) [[unlikely]]
      in_child_();
  }

 private:
  static constexpr unsigned char kAlive = 1;
  // In memory that the kernel clears in a child, however it was forked off.
  static constinit inline const volatile unsigned char* alive_ = &kAlive;
  using InChild = void (*)();
  static constinit inline InChild in_child_ = nullptr;
};

}  // namespace lockstep

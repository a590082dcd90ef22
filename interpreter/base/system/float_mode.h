// How this thread computes with floating-point numbers: the rounding mode, whether tiny numbers are
// flushed to zero, which exceptions trap. All results depend on it, so the mode is restored after a
// plugin changes it (a shared object built with -ffast-math does so when it is loaded).
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <xmmintrin.h>
#elif !defined(__aarch64__)
#include <cfenv>
#endif

namespace lockstep::host {

class FloatMode {
 public:
  static FloatMode current() {
    FloatMode mode;
#if defined(__SSE2__)
    mode.bits_ = _mm_getcsr() & ~kFlags;
    asm volatile("fnstcw %0" : "=m"(mode.x87_));
#elif defined(__aarch64__)
    asm volatile("mrs %0, fpcr" : "=r"(mode.bits_));
#else
    mode.bits_ = static_cast<std::uint64_t>(std::fegetround());
#endif
    return mode;
  }

  void restore() const {
#if defined(__SSE2__)
    _mm_setcsr(static_cast<unsigned>(bits_) | (_mm_getcsr() & kFlags));
    // fldcw itself traps when a flag is set whose exception was made to trap after it had happened.
    asm volatile("fnclex; fldcw %0" : : "m"(x87_));
#elif defined(__aarch64__)
    asm volatile("msr fpcr, %0" : : "r"(bits_));
#else
    std::fesetround(static_cast<int>(bits_));
#endif
  }

  friend bool operator==(const FloatMode&, const FloatMode&) = default;

 private:
  static constexpr unsigned kFlags = 0x3f;  // what happened so far; not a mode
  std::uint64_t bits_ = 0;
  std::uint16_t x87_ = 0;  // long double computes with the old unit, which has a separate mode
};

}  // namespace lockstep::host

#include "base/system/cycle_clock.h"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace lockstep::host {
namespace {

constexpr Nanoseconds kFirstComparison{20'000};
constexpr Nanoseconds kLeastComparison{1'000'000};  // that is more exact than the first

bool counts_evenly() {
#if defined(__x86_64__)
  constexpr unsigned kPowerManagement = 0x80000007, kInvariant = 1u << 8;  // Intel SDM, 18.17
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(kPowerManagement, &a, &b, &c, &d) != 0 && (d & kInvariant) != 0;
#elif defined(__aarch64__)
  return true;  // Arm ARM, D12: the counter has a fixed frequency
#else
  return false;
#endif
}

}  // namespace

CycleClock::CycleClock() : system_(monotonic_now()), counter_(counter()) {
  if (!counts_evenly()) return;
  while (monotonic_now() - system_ < kFirstComparison) {
  }
  scale_ = 1;
  adjust();
}

CycleClock::Reading CycleClock::adjust() {
  const Nanoseconds now = monotonic_now();
  if (scale_ == 0) return {now, now.count()};
  const Nanoseconds passed = now - system_;
  const std::uint64_t count = counter(), counted = count - counter_;
  const Reading reading{now, static_cast<std::int64_t>(count)};
  if (counted == 0 || (scale_ != 1 && passed < kLeastComparison)) return reading;
  scale_ = static_cast<std::uint64_t>(static_cast<double>(passed.count()) /
                                      static_cast<double>(counted) *
                                      static_cast<double>(std::uint64_t{1} << kShift));
  return reading;
}

}  // namespace lockstep::host

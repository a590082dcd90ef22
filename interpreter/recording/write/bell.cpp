#include "recording/write/bell.h"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <climits>
#include <ctime>

namespace lockstep {

void Bell::ring() {
  rung_.fetch_add(1, std::memory_order_release);
  syscall(SYS_futex, &rung_, FUTEX_WAKE_PRIVATE, INT_MAX, nullptr, nullptr, 0);
}

void Bell::wait(std::uint32_t seen, std::chrono::nanoseconds longest) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  const timespec time{.tv_sec = longest.count() / kSecond, .tv_nsec = longest.count() % kSecond};
  syscall(SYS_futex, &rung_, FUTEX_WAIT_PRIVATE, seen, &time, nullptr, 0);
}

}  // namespace lockstep

#include "base/system/futex.h"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <climits>
#include <ctime>

namespace lockstep::host {

void futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t expected, Nanoseconds longest) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  const timespec time{.tv_sec = longest.count() / kSecond, .tv_nsec = longest.count() % kSecond};
  syscall(SYS_futex, &word, FUTEX_WAIT, expected, &time, nullptr, 0);
}

void futex_wake(std::atomic<std::uint32_t>& word) {
  syscall(SYS_futex, &word, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

}  // namespace lockstep::host

#!/usr/bin/env bash
# libstdc++ 12.2.0: a timed wait for hours::max() or nanoseconds::max() times out at once.
#
# condition_variable::wait_for, future::wait_for and timed_mutex::try_lock_for add the duration to the present time of the
# clock, in 64 bits of nanoseconds. The sum overflows, so the deadline is in the past, and the wait reports a timeout
# without having waited. hours::max() overflows even earlier, when it becomes nanoseconds. The standard gives no limit
# for the duration. wait_until(steady_clock::time_point::max()) waits, and so does a wait for hours(24 * 365 * 100).
#
# Debian packages: g++ 12.2.0 (4:12.2.0-3), libstdc++6 12.2.0-14+deb12u1.
set -euo pipefail
[ "$(g++ -dumpfullversion)" = 12.2.0 ] || { echo "needs g++ 12.2.0"; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >wait.cpp <<'CPP'
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <future>
#include <mutex>
#include <thread>

using namespace std::chrono;

// What a thread does after 0.3 s ends the wait.
template <class Wake, class Wait>
void report(const char* what, Wake wake, Wait wait) {
  std::thread later([&] {
    std::this_thread::sleep_for(milliseconds(300));
    wake();
  });
  const auto began = steady_clock::now();
  const bool is_there = wait();
  const bool has_waited = steady_clock::now() - began > milliseconds(200);
  std::printf("%s: %s, %s\n", what, has_waited ? "waited" : "returned at once", is_there ? "woken" : "timeout");
  later.join();
}

template <class Wait>
void with_condition(const char* what, Wait wait) {
  std::mutex mutex;
  std::condition_variable changed;
  bool is_set = false;
  report(
      what,
      [&] {
        const std::lock_guard<std::mutex> lock(mutex);
        is_set = true;
        changed.notify_all();
      },
      [&] {
        std::unique_lock<std::mutex> lock(mutex);
        return wait(changed, lock, [&] { return is_set; });
      });
}

template <class Duration>
void with_future(const char* what, Duration duration) {
  std::promise<void> promise;
  std::future<void> future = promise.get_future();
  report(
      what, [&] { promise.set_value(); }, [&] { return future.wait_for(duration) == std::future_status::ready; });
}

template <class Duration>
void with_condition_for(const char* what, Duration duration) {
  with_condition(what, [&](auto& changed, auto& lock, auto is_set) { return changed.wait_for(lock, duration, is_set); });
}

int main() {
  with_condition_for("condition_variable::wait_for, nanoseconds::max()", nanoseconds::max());
  with_condition_for("condition_variable::wait_for, hours::max()", hours::max());
  with_future("future::wait_for, nanoseconds::max()", nanoseconds::max());
  with_future("future::wait_for, hours::max()", hours::max());
  with_condition_for("condition_variable::wait_for, 100 years", hours(24 * 365 * 100));
  with_condition("condition_variable::wait_until, time_point::max()", [](auto& changed, auto& lock, auto is_set) {
    return changed.wait_until(lock, steady_clock::time_point::max(), is_set);
  });
}
CPP
g++ -std=c++17 -O1 -pthread wait.cpp -o wait
./wait >seen
diff - seen <<'SEEN'
condition_variable::wait_for, nanoseconds::max(): returned at once, timeout
condition_variable::wait_for, hours::max(): returned at once, timeout
future::wait_for, nanoseconds::max(): returned at once, timeout
future::wait_for, hours::max(): returned at once, timeout
condition_variable::wait_for, 100 years: waited, woken
condition_variable::wait_until, time_point::max(): waited, woken
SEEN
echo "libstdc++ 12.2.0: as described"

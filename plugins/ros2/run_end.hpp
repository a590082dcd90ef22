// The leaves of a run share how long its end may wait for goals that were canceled.
#pragma once

#include <chrono>
#include <optional>
#include <thread>

namespace ros2 {

class RunEnd {
 public:
  // Until `is_done()`, at most 1 s for all leaves together.
  template <class Done>
  void wait(Done is_done) {
    using namespace std::chrono_literals;
    const auto now = std::chrono::steady_clock::now();
    if (!until_) until_ = now + 1s;
    while (!is_done() && std::chrono::steady_clock::now() < *until_) {
      std::this_thread::sleep_for(1ms);
    }
  }

 private:
  std::optional<std::chrono::steady_clock::time_point> until_;
};

}  // namespace ros2

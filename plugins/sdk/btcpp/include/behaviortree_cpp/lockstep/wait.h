// A time that a node waits for.
#pragma once

#include <cmath>
#include <cstdint>

namespace BT::lockstep_detail {

// It is asked in ticks, so no thread counts it: what is due happens in the first tick at or after
// its time.
class Wait {
 public:
  // `now` in seconds. The first call begins to count.
  bool is_over(double now, unsigned milliseconds) {
    const std::int64_t time = std::llround(now * 1e9);
    if (!counts_) begin_ = time;
    counts_ = true;
    return time - begin_ >= std::int64_t{milliseconds} * 1'000'000;
  }
  void forget() { counts_ = false; }

 private:
  std::int64_t begin_ = 0;
  bool counts_ = false;
};

}  // namespace BT::lockstep_detail

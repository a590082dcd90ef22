// The questions about a graph end at a time of the real clock: whoever walks along its edges asks.
#pragma once

#include <cstdint>
#include <optional>

#include "base/core/clock.h"

namespace lockstep::host {

struct OutOfTime {};  // is thrown

class TimeLimit {
 public:
  // While this exists, the limit is in force.
  class Span {
   public:
    Span(TimeLimit& limit, std::optional<Nanoseconds> until) : limit_(limit) {
      limit_.until_ = until;
      limit_.looks_ = 0;
    }
    ~Span() { limit_.until_.reset(); }
    Span(const Span&) = delete;
    Span& operator=(const Span&) = delete;

   private:
    TimeLimit& limit_;
  };

  void look() {
    if (until_ && looks_++ % kLooksOfClock == 0 && monotonic_now() > *until_) throw OutOfTime();
  }

 private:
  static constexpr std::uint32_t kLooksOfClock = 1024;  // one in so many
  std::optional<Nanoseconds> until_ = {};
  std::uint32_t looks_ = 0;
};

}  // namespace lockstep::host

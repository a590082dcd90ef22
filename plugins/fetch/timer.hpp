// How far an action of known duration is; it counts the ticks that the action receives, so that it
// stands still while the action is paused.
#pragma once

#include <algorithm>
#include <lockstep/leaf.hpp>
#include <stdexcept>

namespace fetch {

class Timer {
 public:
  void start(double duration) {
    if (!(duration >= 0)) throw std::runtime_error("a duration must not be negative");
    elapsed_ = 0;
    duration_ = duration;
  }
  // Whether it is over.
  bool step(double seconds) {
    elapsed_ += seconds;
    return elapsed_ >= duration_ - kRounding;
  }
  double progress() const { return duration_ > 0 ? std::min(1.0, elapsed_ / duration_) : 1; }

 private:
  static constexpr double kRounding = 1e-9;  // s
  double elapsed_ = 0;
  double duration_ = 0;
};

// An action that takes the time of its port.
template <class Ports>
class TimedAction : public lockstep::Action<Ports> {
 public:
  void start() override { timer_.start(this->seconds.get()); }
  double progress() const override { return timer_.progress(); }

 protected:
  Timer timer_;
};

}  // namespace fetch

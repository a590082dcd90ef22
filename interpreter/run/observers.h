// The observers of one run: makes the Moment of each tick once, with all that any of them asks for,
// and tells them of it in their order.
#pragma once

#include <span>
#include <vector>

#include "run/live_moments.h"
#include "trace/observer.h"

namespace lockstep::host {

class Observers {
 public:
  // The tree and the observers must outlive this.
  Observers(const Tree& tree, std::span<Observer* const> observers);

  void run_started(Ticker& ticker, const RunStart& start);
  // Around the tick, of which the ticker has the time already.
  void before_tick(Ticker& ticker, std::uint64_t tick, Nanoseconds time);
  void after_tick(Ticker& ticker, const TickReport& report);
  void standing(Ticker& ticker);
  void run_ended(Ticker& ticker, const RunEnd& end);

 private:
  std::vector<Observer*> observers_;
  LiveMoments moments_;
};

}  // namespace lockstep::host

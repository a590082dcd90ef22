// Watches a run for standstills (measure/stall.h) and reports them to a callback.
#pragma once

#include <utility>

#include "measure/stall.h"
#include "runtime/observer.h"

namespace lockstep {

class StallObserver final : public Observer {
 public:
  // `report` is called on the tick thread, once for each standstill.
  StallObserver(const Tree& tree, Nanoseconds limit, StallWatch::Report report)
      : watch_(tree, limit, std::move(report)) {}

  void after_tick(Ticker& ticker, const TickReport& report) override {
    watch_.after_tick(ticker, report.time);
  }

 private:
  StallWatch watch_;
};

}  // namespace lockstep

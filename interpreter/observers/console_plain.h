// Tells a run as plain lines, for logs and for whatever is not a terminal: who starts, completes,
// is halted, who waits for whom, which leaf's fault was counted as Failure. Prints at most 200
// lines at once and one a second after that.
#pragma once

#include <atomic>
#include <string_view>
#include <vector>

#include "measure/synchronized_measure.h"
#include "observers/line_budget.h"
#include "runtime/observer.h"
#include "runtime/outlet.h"

namespace lockstep {

class ConsolePlain final : public Observer {
 public:
  static constexpr std::int64_t kBurst = 200;
  // Apart: a fault must not be left out because of who started and completed before it.
  static constexpr std::int64_t kBurstOfFaults = 20;
  // A child that is held for less, on the run's clock, is not told: under a small delta that would
  // be every other tick.
  static constexpr Nanoseconds kShortestWait = std::chrono::milliseconds(100);
  using RealTime = LineBudget::Time (*)();

  // `real_time` is for tests.
  explicit ConsolePlain(const Tree& tree, Outlet& out = messages(),
                        RealTime real_time = std::chrono::steady_clock::now);

  void run_started(Ticker& ticker, const RunStart& start) override;
  void before_tick(Ticker& ticker, std::uint64_t tick, Nanoseconds time) override;
  void after_tick(Ticker& ticker, const TickReport& report) override;
  void run_ended(Ticker& ticker, const RunEnd& end) override;

  // A line that must not be left out, such as a standstill. Any thread.
  void print(std::string_view text);

 private:
  struct Watched {
    SynchronizedProbe probe;
    struct Child {
      bool held = false;
      bool told = false;
      Nanoseconds since{0};
    };
    std::vector<Child> waits;  // of each child
  };
  bool may_print();
  void tell_left_out();
  void tell_fault(const Fault& fault);
  void tell_leaf(NodeIndex leaf, Status before, Status now);
  void tell_held(Ticker& ticker, Watched& node);
  void tell_wait(const Watched& node, std::size_t child, std::string_view text);

  const Tree& tree_;
  Outlet& out_;
  RealTime real_time_;
  LineBudget budget_{kBurst};
  LineBudget fault_budget_{kBurstOfFaults};
  std::vector<NodeIndex> leaves_;
  std::vector<Status> last_;  // of each leaf
  std::vector<Watched> nodes_;
  std::atomic<std::uint64_t> tick_{0};
  std::atomic<Nanoseconds> time_{Nanoseconds(0)};
};

}  // namespace lockstep

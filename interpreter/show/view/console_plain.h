// Reports a run as plain lines, for logs and for output that is not a terminal: which leaf starts,
// completes or is halted, which child waits for which, which fault was counted as Failure. Prints
// at most 200 lines at once and one a second after that. A leaf that completes in the same way in
// tick after tick has one line for the first time and one for all others.
#pragma once

#include <atomic>
#include <optional>
#include <string_view>
#include <vector>

#include "base/terminal/outlet.h"
#include "judge/measure/synchronized_ticks.h"
#include "show/view/line_budget.h"
#include "trace/observer.h"
#include "trace/shape.h"

namespace lockstep::host {

class ConsolePlain final : public Observer {
 public:
  static constexpr std::int64_t kBurst = 200;
  // Separate: a fault must not be left out because of earlier lines about starts and completions.
  static constexpr std::int64_t kBurstOfFaults = 20;
  // A child that waits again so soon after its last wait, on the run's clock, is reported only once
  // it has waited for as long: under a small delta it waits in every other tick.
  static constexpr Nanoseconds kShortWait = std::chrono::milliseconds(100);
  using RealTime = Nanoseconds (*)();

  // `real_time` is for tests.
  explicit ConsolePlain(Shape shape, Outlet& out = messages(), RealTime real_time = monotonic_now);

  // Before the run starts: it continues after a cut, with this tick.
  void continue_with(std::uint64_t tick, Nanoseconds time);
  AskedOfRun asked() const override { return {.within = true}; }
  void run_started(const Moment& moment, const RunStart& start) override;
  void before_tick(const Moment& moment, std::uint64_t tick, Nanoseconds time) override;
  void after_tick(const Moment& moment, const TickReport& report) override;
  void run_ended(const Moment& moment, const RunEnd& end) override;

  // A line that must not be left out, such as a standstill. Any thread.
  void print(std::string_view text);

 private:
  struct Leaf {
    NodeIndex node;
    Status last = Status::Idle;
    // Ticks in which it has completed once more in the same way, since its last line.
    std::uint64_t again = 0, first = 0, latest = 0;
    Nanoseconds latest_time{0};
    std::string reason = {};  // of its last Failure that was printed, up to the first number in it
  };
  struct Wait {
    bool held = false;
    bool told = false;
    Nanoseconds since{0};
    std::string why = {};  // that was printed, up to the first number in it
    std::optional<Nanoseconds> last_end;
  };
  struct Watched {
    SynchronizedTicks ticks;
    std::vector<Wait> waits;     // of each child
    std::vector<double> limits;  // of a pool: of each member
  };
  bool may_print();
  void tell_left_out();
  void tell_fault(const Fault& fault);
  enum class Waits { All, Ends, Begins };
  void tell_waits(const Moment& moment, Waits which = Waits::All);
  void tell_leaves(const Moment& moment);
  void tell_leaf(const Moment& moment, Leaf& leaf, Status now, bool ticked);
  void tell_again(Leaf& leaf, Status status);
  void tell_result(const Moment& moment, Leaf& leaf, Status status);
  static std::string_view kind_of_reason(std::string_view reason);
  std::string_view reason_of(const Moment& moment, const Watched& node, std::size_t child) const;
  static bool fails_otherwise(const Moment& moment, const Leaf& leaf);
  void tell_waits(const Moment& moment, Watched& node, Waits which);
  void tell_wait(const Moment& moment, Watched& node, std::size_t child,
                 const SynchronizedTick& tick);
  static std::string last_word(const Moment& moment, NodeIndex robot, double progress);
  std::string waiting(const Moment& moment, const Watched& node, std::size_t child,
                      const SynchronizedTick& tick) const;
  void tell_end_of_wait(const Moment& moment, Watched& node, std::size_t child);
  void tell(NodeIndex node, std::string_view what);

  const Shape shape_;
  Outlet& out_;
  RealTime real_time_;
  LineBudget budget_{kBurst};
  LineBudget fault_budget_{kBurstOfFaults};
  std::vector<Leaf> leaves_;
  std::vector<Watched> nodes_;
  std::vector<NodeState> within_;
  bool has_ticked_ = false;
  std::uint64_t short_waits_ = 0;  // that were not reported
  std::atomic<std::uint64_t> tick_{0};
  std::atomic<Nanoseconds> time_{Nanoseconds(0)};
};

}  // namespace lockstep::host

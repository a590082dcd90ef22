// A robot of a random team: its tree, ticked by hand over a simulated network.
#pragma once

#include <catch2/catch.hpp>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "run/loading/load.h"
#include "run/observers.h"
#include "run/run.h"
#include "support/plugin_tables.h"
#include "team/simulated_network.h"
#include "team/team_run.h"

namespace lockstep::host::test {

class ManualClock final : public Clock {
 public:
  Nanoseconds now() override { return time; }
  void sleep_until(Nanoseconds) override {}
  bool is_real() const override { return false; }
  Nanoseconds time{0};
};

class SimulatedRobot {
 public:
  // `leaf`: the one type that its tree has, whose instances must be made by the caller.
  SimulatedRobot(const std::string& tree, const lockstep_leaf_type& leaf, Nanoseconds period,
                 std::uint64_t number)
      : period_(period), number_(number), types_{&leaf} {
    plugin_.abi_major = LOCKSTEP_ABI_MAJOR;
    plugin_.abi_minor = LOCKSTEP_ABI_MINOR;
    plugin_.struct_size = sizeof plugin_;
    plugin_.name = "robot";
    plugin_.leaf_type_count = 1;
    plugin_.leaf_types = types_;
    auto plugins = std::make_shared<PluginSet>();
    Diagnostics diagnostics;
    REQUIRE(plugins->add(plugin_, "robot", diagnostics));
    auto loaded = load_text("t.xml", tree, {}, diagnostics, plugins);
    INFO((diagnostics.all().empty() ? std::string() : diagnostics.all().front().message));
    REQUIRE(loaded);
    runnable_ = make_runnable(std::move(*loaded));
    teams_ = teams_of(runnable_.tree, period_);
  }
  SimulatedRobot(const SimulatedRobot&) = delete;
  SimulatedRobot& operator=(const SimulatedRobot&) = delete;

  // A process of it begins. One that ran was killed.
  void begin(SimulatedNetwork& network, Nanoseconds now) {
    end(network);
    clock_.time = now;
    transport_ = &network.join(teams_, clock_);
    team_ = std::make_unique<TeamRun>(runnable_.tree, teams_, 1000 * ++processes_ + number_,
                                      *transport_, clock_);
    team_->use_here();
    run_ = std::make_unique<Run>(runnable_.tree, RunOptions{.rate = 100, .virtual_time = true});
    list_[0] = team_.get();
    observers_ = std::make_unique<Observers>(runnable_.tree, std::span<Observer* const>(list_));
    began_ = next_ = now;
    ticks_ = 0;
    is_over_ = false;
    observers_->run_started(run_->ticker(), {.period = period_, .real_time = false});
  }
  void end(SimulatedNetwork& network) {
    run_.reset();
    observers_.reset();
    team_.reset();
    if (transport_ != nullptr) network.leave(*transport_);
    transport_ = nullptr;
  }

  Nanoseconds now() const { return clock_.time; }
  Nanoseconds next() const { return next_; }
  Nanoseconds period() const { return period_; }
  bool is_over() const { return is_over_; }
  const Tree& tree() const { return runnable_.tree; }
  Ticker& ticker() { return run_->ticker(); }

  // `look`: called between the tick and what is said of it.
  template <class Look>
  void tick(Look look) {
    clock_.time = next_;
    next_ += period_;
    const Nanoseconds time = clock_.time - began_;
    run_->set_now(time);
    observers_->before_tick(ticker(), ticks_, time);
    const Status status = run_->tick();
    look(ticker());
    observers_->after_tick(ticker(), {.tick = ticks_++, .time = time, .status = status});
    is_over_ = is_complete(status);
    if (is_over_) observers_->run_ended(ticker(), {});
  }

 private:
  const Nanoseconds period_;
  const std::uint64_t number_;
  lockstep_plugin plugin_{};
  const lockstep_leaf_type* types_[1];
  Runnable runnable_;
  std::vector<TeamDeclaration> teams_;
  ManualClock clock_;
  TeamTransport* transport_ = nullptr;
  std::unique_ptr<TeamRun> team_;
  std::unique_ptr<Run> run_;
  Observer* list_[1] = {nullptr};
  std::unique_ptr<Observers> observers_;
  std::uint64_t processes_ = 0, ticks_ = 0;
  Nanoseconds began_{0}, next_{0};
  bool is_over_ = false;
};

// Of the robots that run, the one whose tick is the next; its number is the count of all if there
// is none until then.
template <class Robots, class IsGone>
std::size_t next_robot(const Robots& robots, Nanoseconds last, IsGone is_gone) {
  std::size_t next = robots.size();
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (robots[i]->is_over() || is_gone(i) || robots[i]->next() > last) continue;
    if (next == robots.size() || robots[i]->next() < robots[next]->next()) next = i;
  }
  return next;
}

}  // namespace lockstep::host::test

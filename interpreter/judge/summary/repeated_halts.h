// Finds actions that cannot complete, since they are started and halted again and again: a
// condition in front of such an action changes its result all the time. Reports each action once.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "judge/summary/capped_notes.h"
#include "trace/observer.h"
#include "trace/shape.h"

namespace lockstep::host {

class RepeatedHalts final : public Observer {
 public:
  static constexpr std::size_t kHalts = 10;
  static constexpr Nanoseconds kWithin = std::chrono::seconds(1);

  // On the tick thread, in the tick of the last of these halts: the action, and the warning.
  using Tell = std::function<void(NodeIndex action, const std::string& warning)>;
  RepeatedHalts(Shape shape, Tell tell);

  void after_tick(const Moment& moment, const TickReport& report) override;

  void add_to(Summary& summary) const;

 private:
  struct Action {
    NodeIndex node;
    std::uint64_t halts = 0;  // in this run
    bool is_told = false;
    std::array<Nanoseconds, kHalts> times = {};  // of the last halts
  };
  void look(const Moment& moment, std::size_t place);
  void note_halt(const Moment& moment, Action& action);
  std::string cause_of_halt(const Moment& moment, NodeIndex action) const;

  const Shape shape_;
  const Tell tell_;
  std::vector<Action> actions_;
  NodeIndex first_ = 0;           // of the actions
  std::vector<Activity> before_;  // of the nodes from there on, after the last tick
};

}  // namespace lockstep::host

// Ticks the engine from any state of a run, with any answers of its leaves: one for each thread.
#pragma once

#include <optional>
#include <string>

#include "core/clock.h"
#include "leaves/model_leaf.h"
#include "verify/monitor.h"
#include "verify/state_code.h"

namespace lockstep::host {

class Stepper {
 public:
  // All must outlive this.
  Stepper(const Tree& tree, const LeafModels& models, const Monitors& monitors, Nanoseconds period);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  // The state before the first tick.
  StateBytes first_state();

  // From this state on. Then `tick` for each combination of answers, until `next` is false.
  void load(std::span<const std::byte> state, bool is_first);
  // The root's status; Running also after a fault. What the tick did can be looked at until `fold`.
  Status tick();
  bool next() { return odometer_.next(); }
  // The state after a tick.
  const StateBytes& fold();

  Ticker& ticker() { return ticker_; }
  const ModelLeaves& leaves() const { return leaves_; }
  // The property that the tick, or the end in it, has violated; null: none.
  const Monitor* violated() const { return violated_; }

 private:
  void step_monitors(Status status);

  const Tree& tree_;
  const Monitors& monitors_;
  const Nanoseconds period_;
  Blackboard board_;
  Odometer odometer_;
  ModelLeaves leaves_;
  Ticker ticker_;
  SavedRun fresh_, from_;
  StateCode code_;
  std::vector<LeafState> from_leaves_;
  std::vector<FactState> from_facts_;
  StateBytes monitor_bytes_, from_monitors_;
  Nanoseconds time_{0};
  StateBytes folded_;
  const Monitor* violated_ = nullptr;
};

}  // namespace lockstep::host

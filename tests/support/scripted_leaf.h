// A leaf that plays a LeafScript and logs what it is told. The engine reaches it through a plain C
// table (leaf_types below); the reference interpreter calls its functions directly.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "lockstep/leaf.h"
#include "support/leaf_script.h"

namespace lockstep::host::test {

class ScriptedLeaf {
 public:
  using SetError = std::function<void(const char*)>;
  // `tree_tick` counts from 1 (0 before the first). All must outlive the leaf.
  ScriptedLeaf(LeafScript script, std::uint32_t number, const std::uint32_t* tree_tick,
               EventLog* log, SetError set_error)
      : script_(std::move(script)),
        number_(number),
        tree_tick_(tree_tick),
        log_(log),
        set_error_(std::move(set_error)) {}

  void start();
  std::int32_t tick();
  void halt() { told(Call::Halt); }
  void pause();
  void resume();
  double progress() const;
  double set_pace(double factor);
  // All factors that it was told.
  const std::vector<double>& told_paces() const { return told_paces_; }
  // How often it was asked for its progress.
  std::uint64_t asked() const { return asked_; }
  // As a leaf of the same script in another run.
  void go_on_as(const ScriptedLeaf& other) {
    paused_at_ = other.paused_at_;
    ticks_ = other.ticks_;
    activation_ticks_ = other.activation_ticks_;
    progress_ = other.progress_;
    pace_ = other.pace_;
    told_paces_ = other.told_paces_;
  }
  // As new.
  void rewind() {
    paused_at_.reset();
    ticks_ = 0;
    activation_ticks_ = 0;
    progress_ = 0;
    pace_ = 1;
    told_paces_.clear();
  }

 private:
  const LeafScript::Step& next_step() const;
  void told(Call call);
  std::int32_t grow();

  LeafScript script_;
  std::uint32_t number_;
  const std::uint32_t* tree_tick_;
  EventLog* log_;
  SetError set_error_;
  std::size_t ticks_ = 0;  // in all activations
  std::size_t activation_ticks_ = 0;
  double progress_ = 0;
  double pace_ = 1;  // that it took up
  std::vector<double> told_paces_;
  std::optional<std::uint32_t> paused_at_;  // the first tick withheld
  mutable std::uint64_t asked_ = 0;
};

// What the engine calls; `self` is a ScriptedLeaf.
extern const lockstep_leaf_type kScriptedAction;
extern const lockstep_leaf_type kScriptedCondition;
// An action without any function but tick: nothing of it is logged but its ticks.
extern const lockstep_leaf_type kBareAction;
// An action with all functions but start.
extern const lockstep_leaf_type kStartlessAction;

}  // namespace lockstep::host::test

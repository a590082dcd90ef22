#include "support/scripted_leaf.h"

#include <algorithm>
#include <stdexcept>

namespace lockstep::host::test {
namespace {

ScriptedLeaf& leaf(void* self) {
  return *static_cast<ScriptedLeaf*>(self);
}

lockstep_leaf_type bare(lockstep_leaf_kind kind, const char* id) {
  lockstep_leaf_type type{};
  type.struct_size = sizeof type;
  type.kind = kind;
  type.id = id;
  type.tick = [](void* self) -> lockstep_status { return leaf(self).tick(); };
  return type;
}

lockstep_leaf_type full(lockstep_leaf_kind kind, const char* id) {
  lockstep_leaf_type type = bare(kind, id);
  type.start = [](void* self) { leaf(self).start(); };
  type.halt = [](void* self) { leaf(self).halt(); };
  type.pause = [](void* self) { leaf(self).pause(); };
  type.resume = [](void* self) { leaf(self).resume(); };
  type.progress = [](void* self) { return leaf(self).progress(); };
  type.set_pace = [](void* self, double factor) { return leaf(self).set_pace(factor); };
  return type;
}

lockstep_leaf_type startless(lockstep_leaf_kind kind, const char* id) {
  lockstep_leaf_type type = full(kind, id);
  type.start = nullptr;
  return type;
}

}  // namespace

const lockstep_leaf_type kScriptedAction = full(LOCKSTEP_ACTION, "Scripted");
const lockstep_leaf_type kScriptedCondition = full(LOCKSTEP_CONDITION, "ScriptedCondition");
const lockstep_leaf_type kBareAction = bare(LOCKSTEP_ACTION, "Bare");
const lockstep_leaf_type kStartlessAction = startless(LOCKSTEP_ACTION, "Startless");

const LeafScript::Step& ScriptedLeaf::next_step() const {
  const auto& steps = script_.steps;
  return steps[script_.repeats ? ticks_ % steps.size() : std::min(ticks_, steps.size() - 1)];
}

void ScriptedLeaf::told(Call call) {
  log_->push_back({call, number_, 0});
  if (script_.fails_in != call) return;
  if (script_.throws) throw std::runtime_error("thrown by the script");
  set_error_("error of the script");
}

void ScriptedLeaf::start() {
  told(Call::Start);
  activation_ticks_ = 0;
  progress_ = 0;
  pace_ = 1;
  paused_at_.reset();
  if (!script_.growth.empty()) return;
  if (next_step().letter == 'x') set_error_("error of the script");
  if (next_step().letter == 't') throw std::runtime_error("thrown by the script");
}

void ScriptedLeaf::pause() {
  told(Call::Pause);
  paused_at_ = *tree_tick_;
}

void ScriptedLeaf::resume() {
  told(Call::Resume);
  progress_ = progress();
  --asked_;
  paused_at_.reset();
}

double ScriptedLeaf::set_pace(double factor) {
  if (paused_at_) throw std::logic_error("told a pace while it is paused");
  told_paces_.push_back(factor);
  log_->push_back({Call::SetPace, number_, factor});
  pace_ = std::max(factor, script_.least_pace);
  return pace_;
}

std::int32_t ScriptedLeaf::grow() {
  const auto& growth = script_.growth;
  progress_ += growth[std::min(activation_ticks_, growth.size() - 1)] * pace_;
  ++activation_ticks_;
  // Ten steps of 0.1 are one.
  return progress_ >= 1 - 1e-9 ? LOCKSTEP_SUCCESS : LOCKSTEP_RUNNING;
}

std::int32_t ScriptedLeaf::tick() {
  told(Call::Tick);
  if (!script_.growth.empty()) return grow();
  const LeafScript::Step& step = next_step();
  ++ticks_;
  if (step.progress) progress_ = *step.progress;
  switch (step.letter) {
    case 'B':
      return 7;
    case 'T':
      throw std::runtime_error("thrown by the script");
    case 'X':
      set_error_("error of the script");
      return LOCKSTEP_SUCCESS;
    default:
      return static_cast<std::int32_t>(status_letters().find(step.letter));
  }
}

double ScriptedLeaf::progress() const {
  ++asked_;
  if (script_.loss > 0 && paused_at_) {
    return std::max(0.0, progress_ - script_.loss * (*tree_tick_ - *paused_at_));
  }
  if (script_.live.empty()) return progress_;
  const std::size_t tick = *tree_tick_ == 0 ? 0 : *tree_tick_ - 1;
  return script_.live[std::min(tick, script_.live.size() - 1)];
}

}  // namespace lockstep::host::test

#include "leaves/model_leaf.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "base/blackboard/entry.h"
#include "base/system/call_mark.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

// What an object reports that has not begun. No call may read it, so the value is the most harmful
// one.
constexpr double kProgressOfNew = 1.0;
// No call has so many.
constexpr std::uint32_t kStageOfWait = 0xffffffff;

struct ModelLeaves::Functions {
  static Self& self(void* leaf) { return *static_cast<Self*>(leaf); }

  template <class F>
  static lockstep_leaf_type type(F set) {
    lockstep_leaf_type type{};
    type.struct_size = sizeof type;
    type.start = [](void* it) { self(it).all->start(self(it).number); };
    type.tick = [](void* it) {
      return static_cast<lockstep_status>(self(it).all->tick(self(it).number));
    };
    type.halt = [](void* it) { self(it).all->halt(self(it).number); };
    type.pause = [](void* it) { self(it).all->pause(self(it).number); };
    type.resume = [](void* it) { self(it).all->resume(self(it).number); };
    set(type);
    return type;
  }
  static const lockstep_leaf_type& of(const LeafNode& node) {
    static const auto kAction = type([](auto& it) { it.kind = LOCKSTEP_ACTION; });
    static const auto kCondition = type([](auto& it) { it.kind = LOCKSTEP_CONDITION; });
    static const auto kRunningCondition = type([](auto& it) {
      it.kind = LOCKSTEP_CONDITION;
      it.flags = LOCKSTEP_MAY_RUN;
    });
    if (node.type->category != NodeCategory::Condition) return kAction;
    return node.type->can_run ? kRunningCondition : kCondition;
  }
};

std::vector<FactState> first_facts(const LeafModels& models) {
  std::vector<FactState> facts(models.facts.size(), FactState::Unknown);
  for (std::size_t i = 0; i < facts.size(); ++i) {
    if (const auto starts = models.facts[i].starts)
      facts[i] = *starts ? FactState::True : FactState::False;
  }
  return facts;
}

ModelLeaves::ModelLeaves(const Tree& tree, const LeafModels& models, Blackboard& board,
                         Answers& answers)
    : ModelLeaves(
          tree, models,
          [&](std::uint32_t, const LeafModel::Output& output) {
            return &board.entries[output.slot];
          },
          answers) {}

ModelLeaves::ModelLeaves(const Tree& tree, const LeafModels& models, EntryOf entry_of,
                         Answers& answers)
    : tree_(tree),
      models_(models),
      entry_of_(std::move(entry_of)),
      answers_(answers),
      slots_(tree.leaves.size()),
      states_(tree.leaves.size()),
      facts_(first_facts(models)),
      asked_(models.facts.size()),
      progress_(tree.leaves.size()),
      marks_(tree.leaves.size()) {
  static const CallSite kSite;
  for (std::uint32_t i = 0; i < tree.leaves.size(); ++i) {
    rules_.emplace_back(models.leaves[i]);
    selves_.push_back({this, i});
    if (models.leaves[i].drifts()) drifting_.push_back(i);
  }
  for (std::uint32_t i = 0; i < tree.leaves.size(); ++i) {
    slots_[i].type = &Functions::of(tree.leaves[i]);
    slots_[i].self = &selves_[i];
    slots_[i].site = &kSite;
    if (models.leaves[i].has_progress) slots_[i].kept_progress = &progress_[i];
  }
}

void ModelLeaves::set_outside(OutsideLeaves& outside) {
  outside_ = &outside;
  for (std::uint32_t i = 0; i < slots_.size(); ++i) {
    if (outside.has(i)) slots_[i].kept_progress = &progress_[i];
  }
}

void ModelLeaves::restore(const std::vector<LeafState>& states,
                          const std::vector<FactState>& facts) {
  states_ = states;
  facts_ = facts;
  for (std::uint32_t leaf = 0; leaf < states_.size(); ++leaf) restore_progress(leaf);
}

void ModelLeaves::restore_again(const std::vector<LeafState>& states,
                                const std::vector<FactState>& facts) {
  states_ = states;
  facts_ = facts;
  for (const std::uint32_t leaf : touched_) restore_progress(leaf);
}

void ModelLeaves::restore_progress(std::uint32_t leaf) {
  const LeafState& state = states_[leaf];
  progress_[leaf] = is_outside(leaf)            ? outside_->progress(leaf)
                    : state.phase == Phase::Cut ? kProgressOfNew
                                                : rules_[leaf].levels[state.level];
  slots_[leaf].error = nullptr;
}

void ModelLeaves::begin_tick() {
  for (const std::uint32_t leaf : touched_) {
    marks_[leaf].touched = marks_[leaf].is_open = false;
    marks_[leaf].clear();
  }
  touched_.clear();
  chooses_ = kNobody;
  std::fill(asked_.begin(), asked_.end(), false);
}

void ModelLeaves::drift() {
  for (const std::uint32_t leaf : drifting_) {
    if (states_[leaf].phase != Phase::Paused) continue;
    const LevelReach& reach = rules_[leaf].while_held[states_[leaf].level];
    const auto count = static_cast<std::uint32_t>(reach.last - reach.first + 1);
    set_level(leaf, reach.first + static_cast<std::int32_t>(answers_.choose(count, leaf)));
    mark(leaf).drifted = true;
    mark(leaf).held_progress = progress_[leaf];
  }
}

// It is a new object. The engine calls nothing of it before it begins, unless it goes on as it was.
void ModelLeaves::cut(const CutLeaf& leaf) {
  if (leaf.does == AfterCut::Continues) {
    if (rules_[leaf.place].may_wait) mark(leaf.place).is_open = true;
    return;
  }
  mark(leaf.place);
  states_[leaf.place] = LeafState::cut(leaf.does);
  progress_[leaf.place] = kProgressOfNew;
}

void ModelLeaves::clear_marks() {
  for (const std::uint32_t leaf : touched_) marks_[leaf].clear();
}

// A number that only says how often something was counts no further than it matters.
void ModelLeaves::fold() {
  for (const std::uint32_t leaf : touched_) {
    LeafState& state = states_[leaf];
    const Rule& rule = rules_[leaf];
    if (state.phase == Phase::Idle) {
      state = {};
      continue;
    }
    state.ticks = std::min(state.ticks, rule.enough_ticks);
  }
  if (models_.cuts.most > 0) {
    for (std::uint32_t leaf = 0; leaf < states_.size(); ++leaf) {
      const bool is_over = states_[leaf].phase == Phase::Cut && !slots_[leaf].was_cut();
      if (is_over) states_[leaf] = {};  // it has its result, or was halted
    }
  }
  for (std::size_t i = 0; i < facts_.size(); ++i) {
    if (models_.facts[i].changes == Changes::Freely) facts_[i] = FactState::Unknown;
  }
}

void ModelLeaves::tell_broken(std::uint32_t leaf, const char* what) {
  if (broken_.empty()) {
    broken_ = fmt::format("{}: {}", tree_.path(tree_.leaves[leaf].node), what);
  }
}

void ModelLeaves::start(std::uint32_t leaf) {
  is(leaf, !states_[leaf].runs(), "start, and it runs");
  states_[leaf] = {.phase = Phase::Running};
  chooses_ = leaf;
  stage_ = 0;
  mark(leaf).is_open = rules_[leaf].may_wait;
  if (is_outside(leaf)) return outside_->start(leaf);
  set_level(leaf, 0);
  const LeafModel& model = models_.leaves[leaf];
  if (!rules_[leaf].is_plain && model.writes == Writes::AtStart && !model.answers_late) write(leaf);
}

bool ModelLeaves::ask(std::uint32_t fact) {
  const Changes changes = models_.facts[fact].changes;
  FactState& state = facts_[fact];
  if (asked_[fact]) return state == FactState::True;
  asked_[fact] = true;
  const auto asker = static_cast<std::uint32_t>(states_.size()) + fact;
  const bool is_settled = (changes == Changes::Never && state != FactState::Unknown) ||
                          (changes == Changes::Rises && state == FactState::True) ||
                          (changes == Changes::Falls && state == FactState::False);
  if (!is_settled) {
    const auto& chances = models_.facts[fact].chances;
    const bool has_chances = chances[0] > 0;
    const std::uint32_t answer =
        has_chances ? answers_.draw(chances, asker) : answers_.choose(2, asker);
    state = answer == 0 ? FactState::True : FactState::False;
  }
  return state == FactState::True;
}

void ModelLeaves::write(std::uint32_t leaf) {
  for (const LeafModel::Output& output : models_.leaves[leaf].outputs) {
    ++stage_;
    const auto count = static_cast<std::uint32_t>(output.values.size());
    write(leaf, output, answers_.choose(count, leaf));
  }
}

void ModelLeaves::may_write(std::uint32_t leaf, bool has_succeeded) {
  const LeafModel& model = models_.leaves[leaf];
  const bool needs_values = has_succeeded && model.writes == Writes::InAnyTick;
  for (const LeafModel::Output& output : model.outputs) {
    ++stage_;
    const auto count = static_cast<std::uint32_t>(output.values.size());
    const Entry* const entry = needs_values ? entry_of_(leaf, output) : nullptr;
    const bool must = entry != nullptr && !entry->has_value();
    const std::uint32_t choice = answers_.choose(must ? count : count + 1, leaf);
    choice < count ? write(leaf, output, choice) : mark(leaf).written.push_back(kNoWrite);
  }
}

void ModelLeaves::write(std::uint32_t leaf, const LeafModel::Output& output, std::uint32_t value) {
  mark(leaf).written.push_back(value);
  const Parameter& parameter = tree_.leaves[leaf].type->parameters[output.port];
  if (Entry* const entry = entry_of_(leaf, output)) {
    if (write_entry(*entry, parameter.type, parameter.object, output.values[value])) return;
    slots_[leaf].error = "sets an output that its entry does not take";
  }
}

// No loop of leaves goes on after a result that is none, so an error is seen.
Status ModelLeaves::tick(std::uint32_t leaf) {
  const Status result = tick_as_chosen(leaf);
  if (slots_[leaf].error == nullptr) [[likely]]
    return result;
  LeafMark& mark = this->mark(leaf);
  mark.faulted = mark.ended = true;
  mark.result = Status::Failure;
  states_[leaf] = {};
  return Status::Idle;
}

ModelLeaves::Rule::Rule(const LeafModel& model)
    : levels(model.levels.data()),
      can_run(model.can_run),
      is_plain(model.fact == kNoFact && model.sets.empty() && model.outputs.empty()),
      may_write(model.writes >= Writes::InAnyTick && !model.outputs.empty()),
      may_write_idle(model.writes == Writes::InAnyCall && !model.outputs.empty()),
      may_wait(model.waits()),
      results(model.results) {
  const auto count = [](std::int64_t ticks) {
    constexpr std::int64_t kMost = std::numeric_limits<std::uint32_t>::max();
    return static_cast<std::uint32_t>(std::clamp<std::int64_t>(ticks, 0, kMost));
  };
  for (const double it : model.results.chances) {
    if (it > 0 && model.fact == kNoFact) chances.push_back(it);
  }
  least_ticks = count(model.least_ticks);
  most_ticks = count(model.most_ticks);
  if (model.answers_late) be_late(model);
  // Also with a most: one that may not succeed yet, and has no other result, goes on behind it.
  enough_ticks = std::max(least_ticks, most_ticks);
  if (enough_ticks > 0) --enough_ticks;
  if (model.answers_late && model.writes_first()) enough_ticks = std::max(enough_ticks, 1u);
  in_a_tick = reaches_in_a_tick(model);
  while_held = reaches_while_held(model);
}

// What it does with each answer is what its model says. That one of them may count later shows only
// where the model says when something has to happen.
void ModelLeaves::Rule::be_late(const LeafModel& model) {
  // It may stand still once where it would have to succeed, so steps alone are no limit.
  if (model.least_step > 0 && model.finishes_full && model.has_progress && model.results.success &&
      model.least_drift >= 0) {
    const std::int64_t steps = (model.goal + model.least_step - 1) / model.least_step;
    const auto most = static_cast<std::uint32_t>(std::max(steps, model.least_ticks));
    most_ticks = most_ticks == 0 ? most : std::min(most_ticks, most);
  }
}

namespace {

// From one step to another it may come to all levels on the way. No step is so long that it has to
// leave the last level of the tree for one that only a property tells apart.
std::vector<LevelReach> level_reaches(const LeafModel& model, std::int64_t least, std::int64_t most,
                                      std::int32_t last_level) {
  const std::vector<std::int32_t>& steps = model.steps;
  const auto usable = std::span(steps).first(static_cast<std::size_t>(last_level) + 1);
  const bool must_finish = model.finishes_full && model.has_progress;
  const bool is_short = must_finish && last_level + 1 < static_cast<std::int32_t>(steps.size());
  const auto last_step =
      std::min({model.last_step, is_short ? model.goal - 1 : usable.back(), usable.back()});
  std::vector<LevelReach> reaches;
  for (std::size_t level = 0; level < steps.size(); ++level) {
    const std::int64_t from = std::clamp<std::int64_t>(steps[level] + least, 0, last_step);
    const std::int64_t to = std::clamp<std::int64_t>(steps[level] + most, from, usable.back());
    auto first = static_cast<std::int32_t>(std::ranges::lower_bound(usable, from) - usable.begin());
    const auto behind =
        static_cast<std::int32_t>(std::ranges::upper_bound(usable, to) - usable.begin());
    if (least >= 0) first = std::clamp(static_cast<std::int32_t>(level), first, last_level);
    reaches.push_back({.first = first,
                       .last = behind - 1,
                       .may_succeed = !must_finish || steps[level] + most >= model.goal,
                       .must_succeed = must_finish && steps[level] + least >= model.goal});
  }
  return reaches;
}

}  // namespace

std::vector<LevelReach> reaches_in_a_tick(const LeafModel& model) {
  const auto end = static_cast<std::int32_t>(model.levels.size()) - 1;
  const bool ends_at_1 = model.levels.back() >= 1;
  const bool stops_before = model.finishes_full && ends_at_1 && !model.answers_late;
  const std::int32_t last = stops_before ? std::max(end - 1, 0) : end;
  std::vector<LevelReach> reaches = level_reaches(model, model.least_step, model.most_step, last);
  if (!model.answers_late) return reaches;
  // Its success is there, perhaps with the last progress, and counts in the next tick.
  for (std::int32_t level = 0; level <= end; ++level) {
    LevelReach& reach = reaches[static_cast<std::size_t>(level)];
    if (reach.may_succeed) reach.first = std::min(reach.first, level);
    reach.must_succeed =
        reach.must_succeed && model.steps[static_cast<std::size_t>(level)] >= model.goal;
  }
  return reaches;
}

std::vector<LevelReach> reaches_while_held(const LeafModel& model) {
  return level_reaches(model, model.least_drift, model.most_drift,
                       static_cast<std::int32_t>(model.levels.size()) - 1);
}

bool ModelLeaves::may_succeed(std::uint32_t leaf, const LeafState& state) const {
  const Rule& rule = rules_[leaf];
  return rule.results.success && state.ticks + 1 >= rule.least_ticks &&
         rule.in_a_tick[state.level].may_succeed;
}

Status ModelLeaves::tick_as_chosen(std::uint32_t leaf) {
  LeafState& state = states_[leaf];
  const Rule& rule = rules_[leaf];
  const LeafModel& model = models_.leaves[leaf];
  LeafMark& mark = this->mark(leaf);
  is(leaf, state.phase == Phase::Running, "tick without start, or while it is held");
  // The first question has no answer yet, and a second one in a tick of the tree neither.
  const bool may_wait = std::exchange(mark.is_open, rule.may_wait);
  if (mark.ticked && before_tick_again_) {
    before_tick_again_(leaf);
    mark.clear();
  }
  mark.ticked = true;
  if (is_outside(leaf)) return tick_outside(leaf);
  chooses_ = leaf;
  stage_ = 0;
  if (may_wait && answers_.choose(2, leaf) == 1) return wait_for_answer(leaf);
  if (rule.may_wait) ++stage_;
  ++state.ticks;
  const bool writes = model.writes == Writes::InEachTick ||
                      (model.writes == Writes::AtStart && model.answers_late && state.ticks == 1);
  if (!rule.is_plain && writes && !model.outputs.empty()) write(leaf);

  const LevelReach& reach = rule.in_a_tick[state.level];
  const bool may_end = state.ticks >= rule.least_ticks;
  const bool must_succeed = reach.must_succeed && may_end && rule.results.success;
  const bool is_last = rule.most_ticks != 0 && state.ticks >= rule.most_ticks;
  bool may_run = rule.can_run && !is_last && !must_succeed;

  // Chances are of all results, so it ends only where each of them may come.
  const bool is_by_chance = !rule.chances.empty();
  Status ends[3];
  std::uint32_t count = 0;
  bool may_fault = false;
  if (may_end && !rule.is_plain && model.fact != kNoFact) {
    ends[count++] = ask(model.fact) ? Status::Success : Status::Failure;
  } else if (may_end && (!is_by_chance || reach.may_succeed || !rule.results.success)) {
    if (reach.may_succeed && rule.results.success) ends[count++] = Status::Success;
    if (rule.results.failure) ends[count++] = Status::Failure;
    if (rule.results.skipped) ends[count++] = Status::Skipped;
    may_fault = rule.results.fault;
  }
  if (count == 0 && !may_fault && !may_run) {
    rule.can_run ? void(may_run = true) : void(ends[count++] = Status::Success);
  }
  const auto running = may_run ? static_cast<std::uint32_t>(reach.last - reach.first + 1) : 0;
  const std::uint32_t all_ends = count + (may_fault ? 1 : 0);
  const bool draws = is_by_chance && all_ends == rule.chances.size();
  std::uint32_t choice =
      draws ? choose_end(leaf, running) : answers_.choose(all_ends + running, leaf);
  if (choice < count) {
    mark.result = ends[choice];
    mark.ended = true;
    mark.progress = 0;
    if (!rule.is_plain) {
      set_facts(leaf, mark.result);
      if (mark.result == Status::Success && model.writes == Writes::OnSuccess) write(leaf);
    }
    if (rule.may_write) may_write(leaf, mark.result == Status::Success);
    state = {};
    return mark.result;
  }
  choice -= count;
  if (may_fault && choice-- == 0) {
    slots_[leaf].error = "fails as a program, which the leaf model allows";
    return Status::Idle;
  }
  set_level(leaf, reach.first + static_cast<std::int32_t>(choice));
  mark.result = Status::Running;
  mark.progress = progress_[leaf];
  if (rule.may_write) may_write(leaf);
  return Status::Running;
}

// Progress counts as soon as it is there.
Status ModelLeaves::wait_for_answer(std::uint32_t leaf) {
  stage_ = kStageOfWait;
  LeafMark& mark = this->mark(leaf);
  const LevelReach& reach = rules_[leaf].in_a_tick[states_[leaf].level];
  const std::int32_t first = std::min<std::int32_t>(reach.first, states_[leaf].level);
  const auto count = static_cast<std::uint32_t>(reach.last - first + 1);
  set_level(leaf, first + static_cast<std::int32_t>(answers_.choose(count, leaf)));
  mark.result = Status::Running;
  mark.progress = progress_[leaf];
  return Status::Running;
}

// It keeps nothing that a model would: what is outside does.
Status ModelLeaves::tick_outside(std::uint32_t leaf) {
  LeafMark& mark = marks_[leaf];
  mark.result = outside_->tick(leaf);
  mark.ended = mark.result != Status::Running;
  mark.progress = mark.ended ? 0 : progress_[leaf];
  if (mark.ended) states_[leaf] = {};
  return mark.result;
}

// Which of its results comes, or behind them how it runs: first whether it ends, then with what.
std::uint32_t ModelLeaves::choose_end(std::uint32_t leaf, std::uint32_t running) {
  const std::vector<double>& chances = rules_[leaf].chances;
  const std::uint32_t choice = answers_.choose(1 + running, leaf);
  ++stage_;
  if (choice > 0) return choice - 1 + static_cast<std::uint32_t>(chances.size());
  return chances.size() == 1 ? 0 : answers_.draw(chances, leaf);
}

void ModelLeaves::set_facts(std::uint32_t leaf, Status result) {
  for (const LeafModel::Set& set : models_.leaves[leaf].sets) {
    if (result != (set.by_failure ? Status::Failure : Status::Success)) continue;
    facts_[set.fact] = set.value ? FactState::True : FactState::False;
    asked_[set.fact] = true;
  }
}

void ModelLeaves::halt(std::uint32_t leaf) {
  is(leaf, states_[leaf].runs(), "halt, and it does not run");
  states_[leaf] = {};
  mark(leaf).ended = true;
  if (rules_[leaf].may_write_idle) may_write(leaf);
}

void ModelLeaves::pause(std::uint32_t leaf) {
  if (is(leaf, states_[leaf].phase == Phase::Running, "pause, and it gets no ticks")) {
    states_[leaf].phase = Phase::Paused;
  }
  if (rules_[leaf].may_write_idle) may_write(leaf);
}

void ModelLeaves::resume(std::uint32_t leaf) {
  if (is(leaf, states_[leaf].phase == Phase::Paused, "resume, and it is not held")) {
    states_[leaf].phase = Phase::Running;
  }
}

}  // namespace lockstep::host

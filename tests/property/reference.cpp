#include "property/reference.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <ranges>
#include <stdexcept>

#include "property/reference_barrier.h"
#include "property/reference_pace.h"
#include "property/reference_pool.h"
#include "support/scripted_leaf.h"

namespace lockstep::host::test {
namespace {

class Leaf : public ReferenceNode {
 public:
  Leaf(Reference& tree, const Plan& its_plan, std::uint32_t place)
      : ReferenceNode(tree, its_plan),
        leaf_(parse_leaf_script(its_plan.script), place, &world.tick, &events,
              [this](const char* reason) { error_ = reason; }) {}

  Status on_tick(bool first) override {
    const bool bare = plan.kind == "bare";
    if (first && !bare) call([&] { leaf_.start(); });
    status = Status::Running;
    if (paused && !bare) call([&] { leaf_.resume(); });
    if (first) told_ = took_ = 1;
    if (plan.kind == "action" && or_full(world.given) != told_) {
      told_ = or_full(world.given);
      call([&] { took_ = std::clamp(leaf_.set_pace(told_), told_, 1.0); });
    }
    std::int32_t result = 0;
    call([&] { result = leaf_.tick(); });
    const bool may_run = plan.kind != "condition";
    for (const StatusRow& row : kStatuses) {
      const bool may_be = row.status == Status::Running ? may_run : row.status != Status::Idle;
      if (may_be && result == static_cast<std::int32_t>(row.status)) return row.status;
    }
    throw ReferenceFault{number};
  }

  double on_progress() override {
    if (plan.kind == "bare") return 0;
    const double progress = leaf_.progress();
    if (std::isnan(progress)) throw ReferenceFault{number};
    return std::min(1.0, std::max(0.0, progress));
  }

  void on_halt() override {
    if (plan.kind != "bare") call([&] { leaf_.halt(); });
  }

  void on_pause() override {
    if (plan.kind != "bare") call([&] { leaf_.pause(); });
  }

  double taken(double between) override {
    return runs() ? took_ / between : ReferenceNode::taken(between);
  }

 private:
  template <class Function>
  void call(Function function) {
    error_ = nullptr;
    try {
      function();
    } catch (const std::exception&) {
      throw ReferenceFault{number};
    }
    if (error_ != nullptr) throw ReferenceFault{number};
  }

  const char* error_ = nullptr;
  double told_ = 1, took_ = 1;
  ScriptedLeaf leaf_;
};

// Does what the behavior says.
class BehavingLeaf : public ReferenceNode {
 public:
  BehavingLeaf(Reference& tree, const Plan& its_plan, std::uint32_t place)
      : ReferenceNode(tree, its_plan), behavior_(*world.behavior), place_(place) {}

  // "One that was held stays held": what it does after a cut, it does in its next tick.
  Status on_tick(bool first) override {
    const std::optional<AfterCut> was_cut = std::exchange(cut_, std::nullopt);
    if (was_cut == AfterCut::Failure) return Status::Failure;
    if (was_cut == AfterCut::Success) return Status::Success;
    if (first || was_cut) behavior_.start(place_);
    status = Status::Running;
    if (paused && !was_cut) behavior_.resume(place_);
    return behavior_.tick(place_);
  }
  double on_progress() override { return cut_ ? 0 : behavior_.progress(place_); }
  void on_halt() override {
    if (!std::exchange(cut_, std::nullopt)) behavior_.halt(place_);
  }
  void on_pause() override {
    if (!cut_) behavior_.pause(place_);
  }
  bool on_cut() override {
    if (!runs()) return false;
    const AfterCut does = behavior_.cut(place_, !cut_);
    cut_.reset();
    if (does != AfterCut::Continues) cut_ = does;
    return true;
  }
  void keep(KeptState& state) override {
    ReferenceNode::keep(state);
    state(cut_);
  }

 private:
  LeafBehavior& behavior_;
  const std::uint32_t place_;
  std::optional<AfterCut> cut_;  // it was, and has not got a tick since
};

class Constant : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool) override {
    if (plan.kind == "AlwaysSuccess") return Status::Success;
    return plan.kind == "AlwaysFailure" ? Status::Failure : Status::Running;
  }
  double on_progress() override { return 0; }
};

// Nobody answers: "Running until the time is over", then as after the default, or Failure.
class Ask : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool first) override {
    if (first) {
      waited_ = Nanoseconds(0);
    } else if (!paused) {
      waited_ += world.now - counted_until_;
    }
    paused = false;
    counted_until_ = world.now;
    const bool is_over = plan.seconds > 0 && waited_ >= from_seconds(plan.seconds);
    if (first || !is_over) return Status::Running;
    return plan.fallback == "yes" ? Status::Success : Status::Failure;
  }
  void on_pause() override { waited_ += world.now - counted_until_; }
  double on_progress() override { return 0; }
  void keep(KeptState& state) override {
    ReferenceNode::keep(state);
    state.duration(waited_);
    state.moment(counted_until_);
  }

 private:
  Nanoseconds waited_{0}, counted_until_{0};
};

// "Running until the condition is true, then Success; Failure when the time is over."
class WaitUntil : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool first) override {
    if (first) {
      waited_ = Nanoseconds(0);
    } else if (!paused) {
      waited_ += world.now - counted_until_;
    }
    paused = false;
    counted_until_ = world.now;
    if (script().holds(plan.code)) return Status::Success;
    const bool has_limit = plan.seconds > 0;
    return has_limit && waited_ >= from_seconds(plan.seconds) ? Status::Failure : Status::Running;
  }
  void on_pause() override { waited_ += world.now - counted_until_; }
  double on_progress() override { return 0; }
  void keep(KeptState& state) override {
    ReferenceNode::keep(state);
    state.duration(waited_);
    state.moment(counted_until_);
  }

 private:
  Nanoseconds counted_until_{0}, waited_{0};
};

class Script : public ReferenceNode {  // and Check
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool) override {
    if (plan.kind == "Check") {
      return script().holds(plan.code) ? Status::Success : Status::Failure;
    }
    script().run(plan.code);
    return Status::Success;
  }
  double on_progress() override { throw std::logic_error("a script that runs"); }
};

// IfThenElse, WhileDoElse.
class Branches : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool first) override {
    if (first) branch_ = nullptr;
    if (plan.kind == "WhileDoElse" || branch_ == nullptr) {
      const Status condition = child().tick();
      if (!is_complete(condition)) {
        leave(nullptr);
        return condition;
      }
      const std::size_t chosen = condition == Status::Success ? 1 : 2;
      leave(chosen < children.size() ? children[chosen].get() : nullptr);
      if (branch_ == nullptr) return Status::Failure;
    }
    return branch_->tick();
  }
  double on_progress() override {
    return branch_ == nullptr || child().runs() ? 0 : branch_->progress();
  }
  void keep(KeptState& state) override {
    ReferenceNode::keep(state);
    keep_child(state, branch_);
  }

 private:
  void leave(ReferenceNode* next) {
    if (branch_ != nullptr && branch_ != next) branch_->make_idle();
    branch_ = next;
  }
  ReferenceNode* branch_ = nullptr;
};

class Switch : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool first) override {
    if (first) chosen_ = nullptr;
    const double value = script().number(plan.code);
    std::size_t place = 0;
    while (place < plan.cases.size() && std::stod(plan.cases[place]) != value) ++place;
    ReferenceNode* const next = place < children.size() ? children[place].get() : nullptr;
    if (chosen_ != nullptr && chosen_ != next) chosen_->make_idle();
    chosen_ = next;
    return next == nullptr ? Status::Failure : next->tick();
  }
  double on_progress() override { return chosen_ == nullptr ? 0 : chosen_->progress(); }
  void keep(KeptState& state) override {
    ReferenceNode::keep(state);
    keep_child(state, chosen_);
  }

 private:
  ReferenceNode* chosen_ = nullptr;
};

// "Time inside of a slowed child": it counts as slowly as the child goes.
Nanoseconds at_pace(Nanoseconds time, double factor) {
  return time - from_seconds((1 - factor) * to_seconds(time));
}

class Wait : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool first) override {
    if (first)
      waited_ = Nanoseconds(0);
    else
      waited_ = waited_so_far();
    paused = false;
    factor_ = or_full(world.given);
    counted_until_ = world.now;
    return waited_ >= from_seconds(plan.seconds) ? Status::Success : Status::Running;
  }
  void on_pause() override { waited_ = waited_so_far_at_pace(); }
  double taken(double between) override {
    return runs() ? factor_ / between : ReferenceNode::taken(between);
  }
  double on_progress() override {
    const Nanoseconds whole = from_seconds(plan.seconds);  // so that it is the same to the last bit
    return std::min(1.0, to_seconds(waited_so_far()) / to_seconds(whole));
  }
  void keep(KeptState& state) override {
    ReferenceNode::keep(state);
    state.duration(waited_);
    state.moment(counted_until_);
  }

 private:
  Nanoseconds waited_so_far() const { return paused ? waited_ : waited_so_far_at_pace(); }
  Nanoseconds waited_so_far_at_pace() const {
    return waited_ + at_pace(world.now - counted_until_, factor_);
  }
  Nanoseconds waited_{0}, counted_until_{0};
  double factor_ = 1;
};

// Sequence goes on after Success, Fallback after Failure.
class Ordered : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool first) override {
    const Status go_on = plan.kind == "Sequence" ? Status::Success : Status::Failure;
    const std::size_t last = first ? 0 : current();
    waits_before_ = -1;
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (plan.kind == "Sequence" && i > last) {
        waits_before_ = static_cast<int>(i);
        if (is_limit_reached()) {
          note("a Sequence is held between two children");
          return Status::Running;
        }
        waits_before_ = -1;
      }
      const Status before = children[i]->status;
      if (plan.memory && (before == go_on || before == Status::Skipped)) continue;
      const Status result = children[i]->tick();
      if (result == go_on || result == Status::Skipped) continue;
      for (std::size_t later = i + 1; later < children.size(); ++later) {
        children[later]->make_idle();
      }
      return result;
    }
    const bool none = std::ranges::all_of(
        children, [](const auto& child) { return child->status == Status::Skipped; });
    return none ? Status::Skipped : go_on;
  }

  double on_progress() override {
    double done = 0;
    for (auto& child : children) {
      if (done == waits_before_) return done / static_cast<double>(children.size());
      if (child->status != Status::Running) {
        ++done;
      } else if (plan.kind == "Fallback") {
        return child->progress();
      } else {
        return (done + child->progress()) / static_cast<double>(children.size());
      }
    }
    throw std::logic_error("a running Sequence or Fallback without a running child");
  }
  void on_halt() override { waits_before_ = -1; }
  void keep(KeptState& state) override {
    ReferenceNode::keep(state);
    state(waits_before_);
  }

 private:
  // The child at which the last tick ended.
  std::size_t current() const {
    if (waits_before_ >= 0) return static_cast<std::size_t>(waits_before_);
    const auto running = std::ranges::find_if(children, [](auto& it) { return it->runs(); });
    return static_cast<std::size_t>(running - children.begin());
  }

  // "hold=\"between\" looks at the barrier also between the children of a Sequence in a tick." What
  // has no actions is a guard, which is never held.
  bool is_limit_reached() {
    if (is_guard(plan)) return false;
    for (ReferenceNode* branch = this; branch->parent != nullptr; branch = branch->parent) {
      if (branch->parent->is_reached_between([&] { return progress_in_tick(*branch); }))
        return true;
    }
    return false;
  }

  // Of a node around this one: as if the tick ended here.
  double progress_in_tick(ReferenceNode& branch) {
    std::vector<std::pair<ReferenceNode*, Status>> before;
    for (ReferenceNode* node = this; node != branch.parent; node = node->parent) {
      before.emplace_back(node, node->status);
      node->status = Status::Running;
    }
    const double progress = branch.progress();
    for (auto& [node, status_before] : before) node->status = status_before;
    return progress;
  }

  int waits_before_ = -1;
};

class Parallel : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool) override {
    for (auto& child : children) {
      if (may_be_ticked(*child)) child->tick();
    }
    return judge();
  }

 protected:
  // A guard is asked in every tick; an action that completed stays so, unless the node forgets.
  bool may_be_ticked(const ReferenceNode& child) const {
    return plan.forgets || is_guard(child.plan) || !is_complete(child.status);
  }

  Status judge() {
    const int succeeded = count(Status::Success), failed = count(Status::Failure);
    if (there() == 0) return Status::Skipped;
    if (succeeded >= wanted()) return finish(Status::Success);
    if (failed >= (plan.failure_count < 0 ? 1 : plan.failure_count)) return finish(Status::Failure);
    if (there() - failed < wanted()) return finish(Status::Failure);
    return Status::Running;
  }

 public:
  double on_progress() override {
    std::vector<double> all;
    for (auto& child : children) {
      if (child->status != Status::Skipped) all.push_back(child->progress());
    }
    std::sort(all.begin(), all.end(), std::greater<>());
    return all[static_cast<std::size_t>(wanted() - 1)];
  }

 protected:
  int count(Status wanted_status) const {
    return static_cast<int>(std::count_if(children.begin(), children.end(), [&](const auto& child) {
      return child->status == wanted_status;
    }));
  }
  Status finish(Status result) {
    for (auto& child : children) {
      if (child->status == Status::Running) child->make_idle();
    }
    return result;
  }

 private:
  // A skipped child is not.
  int there() const { return static_cast<int>(children.size()) - count(Status::Skipped); }
  int wanted() const {
    return plan.success_count < 0 ? there() : std::min(plan.success_count, there());
  }
};

class Synchronized : public Parallel {
 public:
  Synchronized(Reference& tree, const Plan& its_plan)
      : Parallel(tree, its_plan), pacer_(its_plan, its_plan.children.size()) {}
  Status on_tick(bool first) override {
    snapshot.clear();
    for (auto& child : children) {
      snapshot.push_back(child->status == Status::Skipped ? kLeftOut : reached(*child));
    }
    const ProgressLimit limit(plan);
    if (plan.pace) pace(limit, first);
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (!may_be_ticked(*children[i])) continue;
      if (is_guard(children[i]->plan) || !limit.holds(snapshot[i], least_of(snapshot))) {
        if (plan.pace) {
          const bool is_asked = !is_guard(children[i]->plan);
          children[i]->tick_at_pace(is_asked ? pacer_.given(i) : kNothingAsked);
        } else {
          children[i]->tick();
        }
      } else {
        withhold(*children[i]);
      }
    }
    return judge();
  }

  double on_progress() override {
    double least = 1;
    for (auto& child : children) {
      if (child->status != Status::Skipped) least = std::min(least, reached(*child));
    }
    return least;
  }
  bool is_reached_between(const std::function<double()>& progress) const override {
    return plan.holds_between && ProgressLimit(plan).holds(progress(), least_of(snapshot));
  }

  void on_pause() override { pacer_.pause(world.now); }
  double taken(double between) override {
    if (!plan.pace || !runs()) return Parallel::taken(between);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < children.size(); ++i) {
      least = std::min(least, children[i]->taken(between * pacer_.told(i)));
    }
    return least;
  }

 private:
  void pace(const ProgressLimit& limit, bool first) {
    std::vector<ReferencePacer::Child> all;
    std::ptrdiff_t actions = 0;
    for (std::size_t i = 0; i < children.size(); ++i) {
      ReferenceNode& it = *children[i];
      const bool guard = is_guard(it.plan);
      actions += !guard;
      all.push_back({.node = &it,
                     .reached = snapshot[i],
                     .takes_part = !first && !guard && it.runs(),
                     .was_ticked = it.last_tick == last_tick,
                     .is_held = limit.holds(snapshot[i], least_of(snapshot)),
                     .is_guard = guard});
    }
    const double farthest = limit.farthest(least_of(snapshot));
    // "if success_count is less than the children that contain actions, with a delta, and at a
    // limit of 1 or more"
    const bool is_early = plan.success_count >= 0 && plan.success_count < actions;
    const bool is_delta = plan.kind == "ParallelRelative";
    const bool asks = std::isfinite(farthest) && !(is_early && (is_delta || farthest >= 1));
    pacer_.tick(all, farthest, asks, world.given, world.now, first);
    if (asks) note("a parallel paces");
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (asks && pacer_.told(i) < 1) note("a child is slowed");
    }
  }

  ReferencePacer pacer_;

  void withhold(ReferenceNode& child) const {
    child.withheld_in = world.tick;
    if (child.runs() && !child.paused) child.pause();
  }

  // Nobody waits for a child that has failed and is not ticked again.
  double reached(ReferenceNode& child) const {
    if (child.status == Status::Failure && !may_be_ticked(child)) return 1;
    return child.progress();
  }
};

// Inverter, ForceSuccess, ForceFailure, KeepRunningUntilFailure, SubTree.
class Result : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool) override {
    const Status result = child().tick();
    if (plan.kind == "KeepRunningUntilFailure" && result == Status::Skipped) return Status::Running;
    if (!is_complete(result)) return result;
    const bool success = result == Status::Success;
    if (plan.kind == "Inverter") return success ? Status::Failure : Status::Success;
    if (plan.kind == "ForceSuccess") return Status::Success;
    if (plan.kind == "ForceFailure") return Status::Failure;
    if (plan.kind == "KeepRunningUntilFailure") return success ? Status::Running : Status::Failure;
    return result;
  }
  double on_progress() override { return child().progress(); }
};

class Repeat : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool first) override {
    if (first) done_ = 0;
    const Status result = child().tick();
    if (result != Status::Success) return result;
    return ++done_ == plan.times ? Status::Success : Status::Running;
  }
  double on_progress() override {
    if (plan.times < 0) return child().progress();
    const double current = child().status == Status::Running ? child().progress() : 0;
    return (done_ + current) / plan.times;
  }
  void keep(KeptState& state) override {
    ReferenceNode::keep(state);
    if (plan.times >= 0) state(done_);
  }

 private:
  int done_ = 0;
};

class Retry : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool first) override {
    if (first) failed_ = 0;
    const Status result = child().tick();
    if (result != Status::Failure) return result;
    return ++failed_ == plan.times ? Status::Failure : Status::Running;
  }
  double on_progress() override { return child().progress(); }
  void keep(KeptState& state) override {
    ReferenceNode::keep(state);
    if (plan.times >= 0) state(failed_);
  }

 private:
  int failed_ = 0;
};

class Timed : public ReferenceNode {  // Timeout, Delay
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool first) override {
    if (first)
      counted_ = Nanoseconds(0);
    else if (!paused || plan.wall_clock)
      counted_ += passed();
    counted_until_ = world.now;
    factor_ = or_full(world.given);
    paused = false;
    const bool over = counted_ >= from_seconds(plan.seconds);
    if (plan.kind == "Delay") return over ? child().tick() : Status::Running;
    if (!over) return child().tick();
    child().make_idle();
    return Status::Failure;
  }
  void on_pause() override {
    if (plan.wall_clock) return;
    counted_ += passed();
    counted_until_ = world.now;
  }
  double on_progress() override { return child().progress(); }
  void keep(KeptState& state) override {
    ReferenceNode::keep(state);
    state.duration(counted_);
    state.moment(counted_until_);
  }

 private:
  Nanoseconds passed() const {
    return at_pace(world.now - counted_until_, plan.wall_clock ? 1 : factor_);
  }
  Nanoseconds counted_{0}, counted_until_{0};
  double factor_ = 1;
};

class Cooldown : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool) override {
    if (completed_ && world.now - *completed_ < from_seconds(plan.seconds)) return Status::Skipped;
    completed_.reset();
    const Status result = child().tick();
    if (is_complete(result)) completed_ = world.now;
    return result;
  }
  double on_progress() override { return child().progress(); }
  void keep(KeptState& state) override {
    ReferenceNode::keep(state);
    Nanoseconds completed = completed_.value_or(Nanoseconds(0));
    bool has_completed = completed_.has_value();
    state(has_completed);
    state.moment(completed);
    completed_ = has_completed ? std::optional(completed) : std::nullopt;
  }

 private:
  std::optional<Nanoseconds> completed_;
};

class Rate : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool first) override {
    if (first && result_ && world.now - start_ < from_seconds(plan.seconds)) return *result_;
    if (first) start_ = world.now;
    if (paused && !plan.wall_clock) start_ += world.now - paused_at_;
    result_.reset();
    const Status result = child().tick();
    if (is_complete(result)) result_ = result;
    return result;
  }
  void on_pause() override { paused_at_ = world.now; }
  double on_progress() override { return child().progress(); }
  void keep(KeptState& state) override {
    ReferenceNode::keep(state);
    state(result_);
    if (!paused || plan.wall_clock) return state.moment(start_);
    Nanoseconds counted = paused_at_ - start_;  // it stands while the node is held
    state.duration(counted);
    state.moment(paused_at_);
    start_ = paused_at_ - counted;
  }

 private:
  std::optional<Status> result_;
  Nanoseconds start_{0}, paused_at_{0};
};

class RunOnce : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool) override {
    if (result_) return *result_;
    const Status result = child().tick();
    if (is_complete(result)) result_ = result;
    return result;
  }
  double on_progress() override { return child().progress(); }
  void keep(KeptState& state) override {
    ReferenceNode::keep(state);
    state(result_);
  }

 private:
  std::optional<Status> result_;
};

template <class Node>
std::unique_ptr<ReferenceNode> node(Reference& tree, const Plan& plan) {
  return std::make_unique<Node>(tree, plan);
}

}  // namespace

std::unique_ptr<ReferenceNode> ReferenceNode::make(Reference& tree, const Plan& plan) {
  const std::string& kind = plan.kind;
  if (!plan.script.empty() && tree.world_->behavior != nullptr) {
    return std::make_unique<BehavingLeaf>(tree, plan, tree.world_->leaves++);
  }
  if (!plan.script.empty()) return std::make_unique<Leaf>(tree, plan, tree.world_->leaves++);
  if (kind == "Script" || kind == "Check") return node<Script>(tree, plan);
  if (kind == "Ask") return node<Ask>(tree, plan);
  if (kind == "WaitUntil") return node<WaitUntil>(tree, plan);
  if (kind == "IfThenElse" || kind == "WhileDoElse") return node<Branches>(tree, plan);
  if (kind == "Switch") return node<Switch>(tree, plan);
  if (kind == "Cooldown") return node<Cooldown>(tree, plan);
  if (kind == "Rate") return node<Rate>(tree, plan);
  if (kind.starts_with("Always")) return node<Constant>(tree, plan);
  if (kind == "Wait") return node<Wait>(tree, plan);
  if (kind == "Sequence" || kind == "Fallback") return node<Ordered>(tree, plan);
  if (kind == "Parallel") return node<Parallel>(tree, plan);
  if (kind == "ParallelAbsolute" || kind == "ParallelRelative")
    return node<Synchronized>(tree, plan);
  if (kind == "Repeat") return node<Repeat>(tree, plan);
  if (kind == "Retry") return node<Retry>(tree, plan);
  if (kind == "Timeout" || kind == "Delay") return node<Timed>(tree, plan);
  if (kind == "RunOnce") return node<RunOnce>(tree, plan);
  if (kind == "UseResources") return node<UseResources>(tree, plan);
  if (kind == "SyncProgress") return node<SyncProgress>(tree, plan);
  return node<Result>(tree, plan);
}

Reference::Reference(const Plan& plan, LeafBehavior* behavior) : world_(std::make_unique<World>()) {
  world_->behavior = behavior;
  world_->nodes = &nodes_;
  root_ = ReferenceNode::make(*this, plan);
  for (const ReferenceNode* node : nodes_) {
    for (std::string& text : readings_in(node->plan)) read_.insert(std::move(text));
  }
  for (const Plan* group : groups_of(plan)) {
    if (group->kind == "barrier") {
      groups_.push_back(std::make_unique<ReferenceBarrier>(*this, *group, *root_));
    } else {
      groups_.push_back(std::make_unique<ReferencePool>(*this, *group, *root_));
    }
  }
  order_groups();
  for (ReferenceNode* node : nodes_) find_meanings(*node);
}

// What a barrier holds owns nothing, and a member of a pool owns only while those around it do: the
// barriers come first, and each pool comes after those that it is inside of.
void Reference::order_groups() {
  std::vector<ReferenceGroup*> ordered, pools;
  for (ReferenceGroup* group : world_->groups) {
    (group->plan.kind == "barrier" ? ordered : pools).push_back(group);
  }
  while (!pools.empty()) {
    const auto outermost = std::ranges::find_if(pools, [&](const ReferenceGroup* pool) {
      return std::ranges::none_of(
          pools, [&](auto* other) { return other != pool && pool->is_inside_of(*other); });
    });
    if (outermost == pools.end()) throw std::logic_error("pools inside of each other");
    ordered.push_back(*outermost);
    pools.erase(outermost);
  }
  world_->groups = ordered;
}

// "An attribute on SubTree may remap" the name of a pool: the innermost name whose pool has the
// resource.
void Reference::find_meanings(ReferenceNode& node) const {
  std::vector<const Plan*> around;  // the innermost first
  for (const ReferenceNode* it = node.parent; it != nullptr; it = it->parent) {
    if (!it->plan.renames.empty()) around.push_back(&it->plan);
  }
  std::vector<GroupNames> names(1);
  for (const Plan* tree : around | std::views::reverse) {
    names.push_back(names_inside(*tree, names.back()));
  }
  for (const std::string& text : readings_in(node.plan)) {
    const auto slash = text.find('/');
    if (!text.starts_with("owner(") || slash == text.npos) continue;
    const std::string written = text.substr(6, slash - 6), resource = text.substr(slash + 1, 1);
    for (const GroupNames& inside : names | std::views::reverse) {
      const std::string name = meaning(inside, written);
      const bool has_resource = std::ranges::any_of(world_->groups, [&](const auto* group) {
        const auto* pool = dynamic_cast<const ReferencePool*>(group);
        return pool != nullptr && pool->plan.name == name && pool->knows(resource);
      });
      if (!has_resource) continue;
      node.meanings[text] = "owner(" + name + text.substr(slash);
      break;
    }
  }
}

Reference::~Reference() = default;

// "The value is that of the start of the tick (the snapshot that synchronized nodes use), 0 of an
// idle node, 1 after success until its parent begins again."
bool Reference::read_nodes() {
  auto& readings = world_->entries.readings;
  const auto is_read = [&](const std::string& text) { return read_.contains(text); };
  try {
    for (ReferenceNode* node : nodes_) {
      if (node->plan.script.empty()) continue;
      const std::string of = "(" + node->plan.name + ")";
      if (is_read("progress" + of)) readings["progress" + of] = node->progress();
      readings["held" + of] = node->paused ? 1 : 0;
      readings["status" + of] = static_cast<double>(node->status);
    }
  } catch (const ReferenceFault& fault) {
    world_->fault = fault.node;
    return false;
  }
  for (ReferenceGroup* group : world_->groups) {
    const auto* pool = dynamic_cast<const ReferencePool*>(group);
    for (const char* name : {"A", "B", "C"}) {
      if (pool == nullptr) continue;
      readings["owner(" + pool->plan.name + "/" + name + ")"] = pool->is_owned(name) ? 1 : -1;
    }
  }
  return true;
}

Status Reference::tick(Nanoseconds now) {
  world_->now = now;
  ++world_->tick;
  world_->begin_moments();
  if (!read_nodes()) {
    halt();
    return Status::Running;
  }
  try {
    for (ReferenceGroup* group : world_->groups) group->before_tick();
    const Status status = root_->tick();
    for (ReferenceGroup* group : world_->groups) group->after_tick();
    return status;
  } catch (const ReferenceFault& fault) {
    world_->fault = fault.node;
    halt();
    return Status::Running;
  }
}

void Reference::halt() {
  std::vector<bool> ran;
  for (ReferenceNode* node : nodes_) {
    const bool was_running = ran.emplace_back(node->status == Status::Running);
    node->status = Status::Idle;
    node->paused = false;
    try {
      if (was_running) node->on_halt();
    } catch (const ReferenceFault& fault) {
      if (!world_->fault) world_->fault = fault.node;
    }
  }
  run_halt_scripts(*root_, ran);
}

void Reference::run_halt_scripts(const ReferenceNode& node, const std::vector<bool>& ran) {
  for (const auto& child : node.children) run_halt_scripts(*child, ran);
  if (ran[node.number] && !world_->fault) node.run("on_halt");
}

void Reference::keep(KeptState& state) {
  state(world_->entries.numbers, world_->entries.texts);
  for (ReferenceNode* node : nodes_) node->keep(state);
}

std::string Reference::save(Nanoseconds longest) {
  std::string bytes;
  KeptState state(bytes, {world_->now, world_->tick, longest});
  keep(state);
  return bytes;
}

void Reference::restore(const std::string& bytes, Nanoseconds longest) {
  world_->now = kRestored;
  world_->tick = 1000;
  world_->fault.reset();
  events.clear();
  for (ReferenceNode* node : nodes_) node->last_tick = 0;
  KeptState state(bytes, {world_->now, world_->tick, longest});
  keep(state);
}

Status Reference::status(std::size_t node) const {
  return nodes_[node]->status;
}
bool Reference::ticked(std::size_t node) const {
  return nodes_[node]->last_tick == world_->tick;
}
const std::vector<ReferenceMoment>& Reference::moments() const {
  return world_->moments;
}
bool Reference::held(std::size_t node) const {
  return nodes_[node]->paused;
}
const std::vector<double>& Reference::snapshot(std::size_t node) const {
  return nodes_[node]->snapshot;
}
const std::optional<std::size_t>& Reference::fault() const {
  return world_->fault;
}

const std::map<std::string, long>& Reference::cases() const {
  return world_->cases;
}

bool Reference::cut() {
  bool any = false;
  for (ReferenceNode* node : nodes_) any |= node->on_cut();
  return any;
}

void Reference::write(const std::string& entry, const std::variant<double, std::string>& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    world_->entries.numbers[entry] = *number;
  } else {
    world_->entries.texts[entry] = std::get<std::string>(value);
  }
}

double Reference::progress(std::size_t node) {
  try {
    return nodes_[node]->progress();
  } catch (const ReferenceFault& fault) {
    if (!world_->fault) world_->fault = fault.node;
    return 0;
  }
}

}  // namespace lockstep::host::test

#include "property/reference.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "support/scripted_leaf.h"

namespace lockstep::test {
namespace {

constexpr double kEpsilon = 1e-9;
constexpr double kLeftOut = std::numeric_limits<double>::quiet_NaN();

// Thrown where a leaf breaks its contract: nothing else happens in that tick.
struct LeafFault {
  std::size_t node;
};

}  // namespace

class ReferenceBarrier;

namespace {

// The few forms of scripts in random trees: "x>=y", "x:=1-x;y+=2".
class MiniScript {
 public:
  MiniScript(std::map<std::string, double>& entries, std::size_t node)
      : entries_(entries), node_(node) {}

  bool holds(const std::string& text) const {
    for (const std::string sign : {">=", "==", "!=", "<", ">"}) {
      const auto at = text.find(sign);
      if (at == std::string::npos) continue;
      const double left = value(text.substr(0, at)), right = value(text.substr(at + sign.size()));
      if (sign == ">=") return left >= right;
      if (sign == "==") return left == right;
      if (sign == "!=") return left != right;
      return sign == "<" ? left < right : left > right;
    }
    throw std::logic_error("what is the condition " + text);
  }

  // "x" or "x+y".
  double number(const std::string& text) const {
    const auto plus = text.find('+');
    if (plus == std::string::npos) return value(text);
    return value(text.substr(0, plus)) + value(text.substr(plus + 1));
  }

  void run(const std::string& text) const {
    std::istringstream statements(text);
    for (std::string it; std::getline(statements, it, ';');) {
      const bool adds = it[1] == '+';
      const double right = sum(it.substr(3));
      const std::string name = it.substr(0, 1);
      entries_[name] = adds ? value(name) + right : right;
    }
  }

 private:
  double sum(const std::string& text) const {
    const auto minus = text.find('-');
    if (minus == std::string::npos) return value(text);
    return value(text.substr(0, minus)) - value(text.substr(minus + 1));
  }
  double value(const std::string& text) const {
    if (std::isdigit(static_cast<unsigned char>(text[0])) != 0) return std::stod(text);
    const auto entry = entries_.find(text);
    if (entry == entries_.end()) throw LeafFault{node_};
    return entry->second;
  }

  std::map<std::string, double>& entries_;
  std::size_t node_;
};

}  // namespace

struct Reference::World {
  Nanoseconds now{0};
  std::uint32_t tick = 0;
  std::optional<std::size_t> fault;
  std::uint32_t leaves = 0;
  std::map<std::string, ReferenceGroup*> groups;  // by name
  std::map<std::string, double> entries;
};

class ReferenceNode {
 public:
  using Children = std::vector<std::unique_ptr<ReferenceNode>>;

  ReferenceNode(Reference& tree, const Plan& its_plan)
      : plan(its_plan), world(*tree.world_), events(tree.events), number(tree.nodes_.size()) {
    tree.nodes_.push_back(this);
    for (const Plan& child : plan.children) {
      children.push_back(make(tree, child));
      children.back()->parent = this;
    }
  }
  virtual ~ReferenceNode() = default;
  static std::unique_ptr<ReferenceNode> make(Reference& tree, const Plan& plan);

  Status tick() {
    if (has_ended(status)) {
      for (auto& child : children) child->make_idle();
    }
    status = tick_with_scripts();
    paused = false;
    last_tick = world.tick;
    return status;
  }

  Status tick_with_scripts() {
    const bool first = status != Status::Running;
    if (first && asks("failure_if", false)) return ended(decided(Status::Failure));
    if (first && asks("success_if", false)) return ended(decided(Status::Success));
    if (first && asks("skip_if", false)) return decided(Status::Skipped);
    if (asks("while", true)) return ended(on_tick(first));
    make_idle();
    return first ? decided(Status::Skipped) : Status::Skipped;
  }

  // Before it began: to measures, all children of a synchronized node are as far as it is.
  Status decided(Status result) {
    std::ranges::fill(snapshot, result == Status::Success ? 1.0 : 0.0);
    return result;
  }

  Status ended(Status result) {
    if (!is_complete(result)) return result;
    run(result == Status::Success ? "on_success" : "on_failure");
    run("on_end");
    return result;
  }

  bool asks(const char* hook, bool otherwise) const {
    const auto script = plan.hooks.find(hook);
    return script == plan.hooks.end() ? otherwise : this->script().holds(script->second);
  }
  void run(const char* hook) const {
    const auto script = plan.hooks.find(hook);
    if (script != plan.hooks.end()) this->script().run(script->second);
  }
  MiniScript script() const { return {world.entries, number}; }

  // Halts what runs; all of the subtree is idle then.
  void make_idle() {
    const bool was_running = status == Status::Running;
    status = Status::Idle;
    paused = false;
    if (was_running) on_halt();
    for (auto& child : children) child->make_idle();
    if (was_running) run("on_halt");
  }

  void pause() {
    if (status == Status::Running && !paused) {
      paused = true;
      on_pause();
    }
    for (auto& child : children) child->pause();
  }

  double progress() {
    if (status == Status::Running) return on_progress();
    return status == Status::Success ? 1 : 0;
  }

  virtual Status on_tick(bool first) = 0;
  virtual double on_progress() = 0;
  virtual void on_halt() {}
  virtual void on_pause() {}

  ReferenceNode& child() { return *children.front(); }

  ReferenceNode* parent = nullptr;
  const Plan& plan;
  Reference::World& world;
  EventLog& events;
  std::size_t number;
  Children children;
  Status status = Status::Idle;
  bool paused = false;
  std::uint32_t last_tick = 0;
  std::vector<double> snapshot;
};

namespace {

std::optional<double> next_barrier(const Plan& plan, double least) {
  std::vector<double> barriers = plan.barriers;
  for (int i = 1; i <= plan.barrier_count; ++i) {
    barriers.push_back(static_cast<double>(i) / plan.barrier_count);
  }
  for (const double barrier : barriers) {
    if (barrier > least + kEpsilon) return barrier;
  }
  return std::nullopt;
}

// By the parameters of a synchronized parallel, or of a barrier beside the tree.
bool is_held(const Plan& plan, double progress, double least) {
  if (std::isnan(progress)) return false;
  if (!plan.has_barriers && plan.barrier_count < 0) return progress > least + plan.delta + kEpsilon;
  const auto barrier = next_barrier(plan, least);
  if (!barrier) return false;
  return plan.tick_at_barrier ? progress > *barrier + kEpsilon : progress >= *barrier - kEpsilon;
}

class Leaf : public ReferenceNode {
 public:
  Leaf(Reference& tree, const Plan& its_plan, std::uint32_t place)
      : ReferenceNode(tree, its_plan),
        leaf_(parse_leaf_script(its_plan.script), place, &world.tick, &events, &error_) {}

  Status on_tick(bool first) override {
    const bool bare = plan.kind == "bare";
    if (first && !bare) call([&] { leaf_.start(); });
    status = Status::Running;
    if (paused && !bare) call([&] { leaf_.resume(); });
    std::int32_t result = 0;
    call([&] { result = leaf_.tick(); });
    const bool may_run = plan.kind != "condition";
    for (const StatusRow& row : kStatuses) {
      const bool may_be = row.status == Status::Running ? may_run : row.status != Status::Idle;
      if (may_be && result == static_cast<std::int32_t>(row.status)) return row.status;
    }
    throw LeafFault{number};
  }

  double on_progress() override {
    if (plan.kind == "bare") return 0;
    const double progress = leaf_.progress();
    if (std::isnan(progress)) throw LeafFault{number};
    return std::min(1.0, std::max(0.0, progress));
  }

  void on_halt() override {
    if (plan.kind != "bare") call([&] { leaf_.halt(); });
  }

  void on_pause() override {
    if (plan.kind != "bare") call([&] { leaf_.pause(); });
  }

 private:
  template <class Function>
  void call(Function function) {
    error_ = nullptr;
    try {
      function();
    } catch (const std::exception&) {
      throw LeafFault{number};
    }
    if (error_ != nullptr) throw LeafFault{number};
  }

  const char* error_ = nullptr;
  ScriptedLeaf leaf_;
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
  double on_progress() override { return branch_ == nullptr ? 0 : branch_->progress(); }

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

 private:
  ReferenceNode* chosen_ = nullptr;
};

class Wait : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool first) override {
    if (first)
      waited_ = Nanoseconds(0);
    else
      waited_ = waited_so_far();
    paused = false;
    counted_until_ = world.now;
    return waited_ >= from_seconds(plan.seconds) ? Status::Success : Status::Running;
  }
  void on_pause() override { waited_ += world.now - counted_until_; }
  double on_progress() override {
    return std::min(1.0, to_seconds(waited_so_far()) / plan.seconds);
  }

 private:
  Nanoseconds waited_so_far() const {
    return paused ? waited_ : waited_ + (world.now - counted_until_);
  }
  Nanoseconds waited_{0}, counted_until_{0};
};

// Sequence goes on after Success, Fallback after Failure.
class Ordered : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool) override {
    const Status go_on = plan.kind == "Sequence" ? Status::Success : Status::Failure;
    for (std::size_t i = 0; i < children.size(); ++i) {
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
  using Parallel::Parallel;
  Status on_tick(bool) override {
    snapshot.clear();
    double least = 1;
    for (auto& child : children) {
      snapshot.push_back(child->status == Status::Skipped ? kLeftOut : reached(*child));
      if (!std::isnan(snapshot.back())) least = std::min(least, snapshot.back());
    }
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (!may_be_ticked(*children[i])) continue;
      if (is_guard(children[i]->plan) || !is_held(plan, snapshot[i], least)) {
        children[i]->tick();
      } else if (children[i]->status == Status::Running && !children[i]->paused) {
        children[i]->pause();
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

 private:
  // Nobody waits for a child that has failed and is not ticked again.
  double reached(ReferenceNode& child) const {
    if (child.status == Status::Failure && !may_be_ticked(child)) return 1;
    return child.progress();
  }
};

class SyncProgress : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;
  Status on_tick(bool first) override;
  double on_progress() override { return child().progress(); }
  bool is_held() const;

 private:
  ReferenceBarrier& barrier() const;
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
      counted_ += world.now - counted_until_;
    counted_until_ = world.now;
    paused = false;
    const bool over = counted_ >= from_seconds(plan.seconds);
    if (plan.kind == "Delay") return over ? child().tick() : Status::Running;
    if (!over) return child().tick();
    child().make_idle();
    return Status::Failure;
  }
  void on_pause() override {
    if (plan.wall_clock) return;
    counted_ += world.now - counted_until_;
    counted_until_ = world.now;
  }
  double on_progress() override { return child().progress(); }

 private:
  Nanoseconds counted_{0}, counted_until_{0};
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

 private:
  std::optional<Status> result_;
};

template <class Node>
std::unique_ptr<ReferenceNode> node(Reference& tree, const Plan& plan) {
  return std::make_unique<Node>(tree, plan);
}

}  // namespace

// A node of its own behind the tree: it looks before the root is ticked.
class ReferenceGroup : public ReferenceNode {
 public:
  ReferenceGroup(Reference& tree, const Plan& its_plan, ReferenceNode& root)
      : ReferenceNode(tree, its_plan) {
    std::vector<ReferenceNode*> way;
    find_members(root, way);
    world.groups[plan.name] = this;
  }

  virtual void before_tick() = 0;
  void after_tick() {
    if (ancestor().status != Status::Running && status == Status::Running) status = Status::Idle;
  }
  Status on_tick(bool) override { throw std::logic_error("a group is not in the tree"); }

  std::vector<ReferenceNode*> members;

 protected:
  // The last node on the way to every member; the root, when that is the only member.
  ReferenceNode& ancestor() const {
    ReferenceNode* last = members[0];
    for (std::size_t level = 0;; ++level) {
      for (const auto& way : ways_) {
        if (level >= way.size() || way[level] != ways_[0][level]) return *last;
      }
      last = ways_[0][level];
    }
  }

  std::vector<std::vector<ReferenceNode*>> ways_;  // to each member, from the root

 private:
  void find_members(ReferenceNode& node, std::vector<ReferenceNode*>& way) {
    if (node.plan.barrier == plan.name || node.plan.pool == plan.name) {
      members.push_back(&node);
      ways_.push_back(way);
    }
    way.push_back(&node);
    for (auto& child : node.children) find_members(*child, way);
    way.pop_back();
  }
};

class ReferenceBarrier : public ReferenceGroup {
 public:
  ReferenceBarrier(Reference& tree, const Plan& its_plan, ReferenceNode& root)
      : ReferenceGroup(tree, its_plan, root) {
    held.resize(members.size());
    succeeded.resize(members.size());
  }

  void before_tick() override {
    const bool begins = ancestor().status != Status::Running;
    if (begins) succeeded.assign(members.size(), false);
    snapshot.clear();
    double least = 1;
    for (std::size_t i = 0; i < members.size(); ++i) {
      snapshot.push_back(reached(i, begins));
      if (!std::isnan(snapshot[i])) least = std::min(least, snapshot[i]);
    }
    for (std::size_t i = 0; i < members.size(); ++i) {
      held[i] = !succeeded[i] && !is_guard(members[i]->plan) && !std::isnan(snapshot[i]) &&
                is_held(plan, snapshot[i], least);
    }
    status = all_succeeded() ? Status::Success : Status::Running;
  }

  void succeed(std::size_t member) {
    succeeded[member] = true;
    if (all_succeeded()) status = Status::Success;
  }

  std::size_t place_of(const ReferenceNode& member) const {
    return static_cast<std::size_t>(std::ranges::find(members, &member) - members.begin());
  }

  double on_progress() override {
    double least = 1;
    for (const double one : snapshot) {
      if (one < least) least = one;
    }
    return least;
  }

  std::vector<bool> held, succeeded;

 private:
  bool all_succeeded() const { return std::ranges::find(succeeded, false) == succeeded.end(); }

  double reached(std::size_t i, bool begins) {
    ReferenceNode& member = *members[i];
    if (begins || (!succeeded[i] && member.status == Status::Idle)) {
      return plan.ignores_idle ? kLeftOut : 0;
    }
    if (succeeded[i] && !is_guard(member.plan)) return 1;
    if (member.status == Status::Skipped) return kLeftOut;
    if (member.status == Status::Failure && is_over(i)) return 1;
    return member.progress();
  }

  // It failed, and a parallel below the ancestor keeps that result, or one that came of it.
  bool is_over(std::size_t i) const {
    std::vector<ReferenceNode*> way = ways_[i];
    way.push_back(members[i]);
    for (std::size_t at = way.size() - 1; way[at] != &ancestor() && at > 0; --at) {
      const Plan& around = way[at - 1]->plan;
      if (!around.kind.starts_with("Parallel") || around.forgets) continue;
      if (is_complete(way[at]->status) && !is_guard(way[at]->plan)) return true;
    }
    return false;
  }
};

Status SyncProgress::on_tick(bool) {
  ReferenceBarrier& barrier = this->barrier();
  barrier.last_tick = world.tick;
  const std::size_t place = barrier.place_of(*this);
  if (barrier.held[place]) {
    if (child().status == Status::Running && !child().paused) child().pause();
    return Status::Running;
  }
  const Status result = child().tick();
  if (result == Status::Success) barrier.succeed(place);
  return result;
}

ReferenceBarrier& SyncProgress::barrier() const {
  return dynamic_cast<ReferenceBarrier&>(*world.groups.at(plan.barrier));
}

bool SyncProgress::is_held() const {
  return barrier().held[barrier().place_of(*this)];
}

class ReferencePool : public ReferenceGroup {
 public:
  using ReferenceGroup::ReferenceGroup;
  void before_tick() override;
  double on_progress() override { return 0; }

  std::set<std::string> owned;  // in this tick
};

class UseResources : public ReferenceNode {
 public:
  using ReferenceNode::ReferenceNode;

  Status on_tick(bool) override {
    pool().last_tick = world.tick;
    if (asked_ != world.tick) ask();
    if (owns_) {
      const Status result = child().tick();
      if (result == Status::Skipped) give_back();
      return result;
    }
    if (is_open()) priority += pool().plan.increment;
    if (child().status == Status::Running && !child().paused) child().pause();
    return Status::Running;
  }
  double on_progress() override { return child().progress(); }

  void ask() {
    asked_ = world.tick;
    owns_ = is_open() && std::ranges::none_of(names(), [this](const std::string& name) {
              return pool().owned.contains(name);
            });
    if (owns_) own();
  }

  bool keeps() { return plan.keep && child().status == Status::Running; }
  void keep() {
    asked_ = world.tick;
    owns_ = true;
    own();
  }

  // What a parallel does in this tick is not known before its tick.
  bool is_held_by_parallel() const {
    if (!paused) return false;
    const ReferenceNode* holder = this;
    while (holder->paused) holder = holder->parent;
    return holder->plan.kind.starts_with("Parallel");
  }

  int priority = 0;

 private:
  ReferencePool& pool() const { return dynamic_cast<ReferencePool&>(*world.groups.at(plan.pool)); }

  std::set<std::string> names() const {
    std::set<std::string> names;
    std::istringstream text(plan.resources);
    for (std::string name; std::getline(text, name, ';');) names.insert(name);
    return names;
  }
  void own() {
    for (const std::string& name : names()) pool().owned.insert(name);
    priority = 0;
  }

  void give_back() {
    for (const std::string& name : names()) pool().owned.erase(name);
  }

  // No barrier and no other pool withholds ticks, as far as is known before the tick.
  bool is_open() const {
    for (const ReferenceNode* node = parent; node != nullptr; node = node->parent) {
      const auto* barrier = dynamic_cast<const SyncProgress*>(node);
      if (barrier != nullptr && barrier->is_held()) return false;
      const auto* outer = dynamic_cast<const UseResources*>(node);
      if (outer != nullptr && !(outer->asked_ == world.tick && outer->owns_)) return false;
    }
    const ReferenceNode* below = children.front().get();
    while (below->children.size() == 1 && below->plan.barrier.empty() && below->plan.pool.empty()) {
      below = below->children.front().get();
    }
    const auto* barrier = dynamic_cast<const SyncProgress*>(below);
    return barrier == nullptr || !barrier->is_held();
  }

  std::uint32_t asked_ = 0;
  bool owns_ = false;
};

void ReferencePool::before_tick() {
  status = Status::Running;
  owned.clear();
  std::vector<UseResources*> asking;
  for (ReferenceNode* node : members) {
    auto* member = dynamic_cast<UseResources*>(node);
    if (member->status != Status::Running) continue;
    if (member->keeps()) {
      member->keep();
    } else if (!member->is_held_by_parallel()) {
      asking.push_back(member);
    }
  }
  std::ranges::stable_sort(asking, std::greater<>(), &UseResources::priority);
  for (UseResources* member : asking) member->ask();
}

std::unique_ptr<ReferenceNode> ReferenceNode::make(Reference& tree, const Plan& plan) {
  const std::string& kind = plan.kind;
  if (!plan.script.empty()) return std::make_unique<Leaf>(tree, plan, tree.world_->leaves++);
  if (kind == "Script" || kind == "Check") return node<Script>(tree, plan);
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

Reference::Reference(const Plan& plan)
    : world_(std::make_unique<World>()), root_(ReferenceNode::make(*this, plan)) {
  for (const Plan* group : groups_of(plan)) {
    if (group->kind == "barrier") {
      groups_.push_back(std::make_unique<ReferenceBarrier>(*this, *group, *root_));
    } else {
      groups_.push_back(std::make_unique<ReferencePool>(*this, *group, *root_));
    }
  }
}

Reference::~Reference() = default;

Status Reference::tick(Nanoseconds now) {
  world_->now = now;
  ++world_->tick;
  try {
    for (auto& group : groups_) group->before_tick();
    const Status status = root_->tick();
    for (auto& group : groups_) group->after_tick();
    return status;
  } catch (const LeafFault& fault) {
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
    } catch (const LeafFault& fault) {
      if (!world_->fault) world_->fault = fault.node;
    }
  }
  run_halt_scripts(*root_, ran);
}

void Reference::run_halt_scripts(const ReferenceNode& node, const std::vector<bool>& ran) {
  for (const auto& child : node.children) run_halt_scripts(*child, ran);
  if (ran[node.number] && !world_->fault) node.run("on_halt");
}

Status Reference::status(std::size_t node) const {
  return nodes_[node]->status;
}
bool Reference::ticked(std::size_t node) const {
  return nodes_[node]->last_tick == world_->tick;
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

double Reference::progress(std::size_t node) {
  try {
    return nodes_[node]->progress();
  } catch (const LeafFault& fault) {
    if (!world_->fault) world_->fault = fault.node;
    return 0;
  }
}

}  // namespace lockstep::test

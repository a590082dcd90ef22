#include "property/tree_generator.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "property/plan_repair.h"

namespace lockstep::host::test {
namespace {

constexpr std::array kFractions{.1, .2, .25, .3, .4, .5, .6, .7, .75, .8, .9, 1.0};

}  // namespace

double TreeGenerator::fraction() {
  return pick(kFractions);
}

Trial TreeGenerator::trial() {
  Trial trial;
  budget_ = between(1, one_in(4) ? 40 : 14);
  faults_ = one_in(3);
  skips_ = one_in(2);
  scripts_ = one_in(2);
  trial.plan = scripts_ ? with_entries(node(1)) : node(1);
  trial.plan.beside = {barrier("g0"), barrier("g1"), pool("p"), pool("q")};
  take_out_lonely_members(trial.plan);
  take_out_unknown_readings(trial.plan);
  draw_times(trial);
  return trial;
}

void TreeGenerator::draw_times(Trial& trial) {
  trial.period = pick(std::array{.1, .05, .13, 1.0});
  trial.ticks = between(5, 60);
  trial.halt_every = one_in(3) ? between(2, 15) : 0;
  trial.watched = one_in(2);
}

Plan TreeGenerator::with_entries(Plan plan) {
  return Plan{.kind = "Sequence",
              .children = {Plan{.kind = "Script", .code = kStart}, std::move(plan)},
              .memory = true};
}

Plan TreeGenerator::node(int depth) {
  Plan plan = bare_node(depth);
  if (scripts_ && plan.kind != "bare") add_hooks(plan);
  return plan;
}

// Some read what comes later in the tree, or is nowhere: that is repaired.
std::string TreeGenerator::reading() {
  const std::string leaf = fmt::format("(a{})", between(0, static_cast<int>(leaves_) + 1));
  switch (between(0, 4)) {
    case 0:
      return "held" + leaf + pick(std::array{"==true", "==false"});
    case 1:
      return fmt::format("owner({}/{}){}none", pick(std::array{"p", "q"}),
                         pick(std::array{"A", "B", "C"}), pick(std::array{"==", "!="}));
    case 2:
      return "status" + leaf + pick(std::array{"==", "!="}) +
             pick(std::array{"idle", "running", "success", "failure", "skipped"});
    default:
      return "progress" + leaf + pick(std::array{">=", "<", ">", "=="}) +
             fmt::format("{}", one_in(4) ? 0.0 : fraction());
  }
}

std::string TreeGenerator::condition() {
  if (one_in(3)) return reading();
  return pick(std::array{"x>0", "x<2", "x==y", "y!=1", "x>=y", "x<3", "y<4"});
}

std::string TreeGenerator::assignment() {
  if (!assignments_.empty() && one_in(2)) return pick(assignments_);
  return pick(std::array{"x+=1", "x:=0", "y:=1", "y:=x", "x:=1-x", "y:=3-y", "y+=1", "x:=y-x"});
}

void TreeGenerator::add_hooks(Plan& plan) {
  // These have a result that only a script gives.
  const bool needs_it = plan.kind == "AlwaysRunning" || plan.kind.starts_with("Force") ||
                        plan.kind == "KeepRunningUntilFailure";
  for (const char* hook : {"failure_if", "success_if", "skip_if", "while"}) {
    if (one_in(needs_it ? 3 : 10)) plan.hooks[hook] = condition();
  }
  for (const char* hook : {"on_success", "on_failure", "on_end", "on_halt"}) {
    if (one_in(10)) plan.hooks[hook] = assignment();
  }
}

Plan TreeGenerator::bare_node(int depth) {
  --budget_;
  if (depth == kMaxDepth || budget_ <= 0 || (depth > 1 && one_in(4))) return leaf();
  switch (between(0, 12)) {
    case 12:
      return cases(depth);
    case 10:
      return branches("IfThenElse", depth);
    case 11:
      return branches("WhileDoElse", depth);
    case 0:
    case 1:
      return control("Sequence", depth);
    case 2:
      return control("Fallback", depth);
    case 3:
      return control("Parallel", depth);
    case 4:
    case 5:
      return control("ParallelAbsolute", depth);
    case 6:
    case 7:
      return control("ParallelRelative", depth);
    default:
      return decorator(depth);
  }
}

Plan TreeGenerator::control(std::string kind, int depth) {
  Plan plan{.kind = std::move(kind)};
  const int children = between(1, 4);
  const bool is_parallel = plan.kind.starts_with("Parallel");
  for (int i = 0; i < children; ++i) {
    plan.children.push_back(is_parallel ? child_of_parallel(depth + 1) : node(depth + 1));
  }
  if (!is_parallel) plan.memory = one_in(2);
  if (is_parallel && one_in(6)) plan.forgets = true;
  if (is_parallel && one_in(2)) plan.success_count = between(1, children);
  if (is_parallel && one_in(2)) plan.failure_count = between(1, children);
  if (plan.kind == "ParallelRelative") {
    plan.delta = one_in(4) ? between(0, 1) : fraction();
    plan.holds_between = one_in(3);
  }
  if (plan.kind == "ParallelAbsolute") barriers(plan);
  return plan;
}

Plan TreeGenerator::child_of_parallel(int depth) {
  if (one_in(5)) return guard(depth);
  if (one_in(5)) return sync_progress(pick(barriers_), node(depth + 1));
  if (has_pool_left() && one_in(4)) return use_resources([&] { return node(depth + 1); });
  return node(depth);
}

Plan TreeGenerator::branches(std::string kind, int depth) {
  Plan plan{.kind = std::move(kind)};
  plan.children.push_back(one_in(3) ? node(depth + 1) : guard(depth + 1));
  for (int i = between(1, 2); i > 0; --i) plan.children.push_back(node(depth + 1));
  return plan;
}

Plan TreeGenerator::cases(int depth) {
  Plan plan{.kind = "Switch"};
  plan.code = scripts_ ? pick(std::array{"x", "y", "x+y"}) : pick(std::array{"1", "2"});
  const int count = between(1, 3);
  for (int i = 0; i < count; ++i) plan.cases.push_back(std::to_string(i));
  for (int i = count + between(0, 1); i > 0; --i) plan.children.push_back(node(depth + 1));
  return plan;
}

Plan TreeGenerator::guard(int depth) {
  --budget_;
  if (scripts_ && one_in(3)) return Plan{.kind = "Check", .code = condition()};
  if (depth >= kMaxDepth || !one_in(3)) return scripted("condition");
  Plan plan{.kind = pick(std::array{"Sequence", "Fallback", "Parallel", "Inverter", "Delay",
                                    "Repeat", "SubTree", "Rate", "Cooldown"})};
  const bool is_control =
      plan.kind == "Sequence" || plan.kind == "Fallback" || plan.kind == "Parallel";
  for (int i = is_control ? between(1, 3) : 1; i > 0; --i) {
    plan.children.push_back(guard(depth + 1));
  }
  if (plan.kind == "Repeat") plan.times = between(1, 3);
  plan.seconds = .05 * between(0, 10);
  return plan;
}

void TreeGenerator::barriers(Plan& plan) {
  plan.holds_between = one_in(3);
  plan.tick_at_barrier = one_in(3);
  if (one_in(3)) {
    plan.barrier_count = between(0, 5);
    return;
  }
  plan.has_barriers = true;
  if (one_in(3)) plan.barriers.push_back(0);
  for (const double value : kFractions) {
    if (one_in(4)) plan.barriers.push_back(value);
  }
}

Plan TreeGenerator::barrier(std::string name) {
  Plan plan{.kind = "barrier", .name = std::move(name)};
  plan.ignores_idle = one_in(2);
  if (one_in(2)) {
    barriers(plan);
  } else {
    plan.delta = one_in(4) ? between(0, 1) : fraction();
    plan.holds_between = one_in(3);
  }
  return plan;
}

Plan TreeGenerator::pool(std::string name) {
  Plan plan{.kind = "resources", .name = std::move(name)};
  plan.increment = between(0, 2);
  return plan;
}

Plan TreeGenerator::sync_progress(const std::string& barrier, Plan child) {
  return {.kind = "SyncProgress", .children = {std::move(child)}, .barrier = written(barrier)};
}

Plan TreeGenerator::use_resources(const std::function<Plan()>& child) {
  Plan plan{.kind = "UseResources"};
  const auto last = static_cast<int>(pools_.size()) - 1;
  const bool is_nested_again = next_pool_ > 0 && one_in(3);
  const auto place = is_nested_again
                         ? next_pool_ - 1
                         : static_cast<std::size_t>(between(static_cast<int>(next_pool_), last));
  plan.pool = written(pools_[place]);
  plan.resources = pick(std::array{"A", "B", "C", "A;B", "B;C", "A;C", "A;B;C", "any(A;B)",
                                   "any(C;B;A)", "B;any(C;A)"});
  if (!resource_keys_.empty() && one_in(3)) plan.from_entries["resources"] = pick(resource_keys_);
  if (!resource_keys_.empty() && one_in(6)) plan.from_entries["granted"] = pick(resource_keys_);
  plan.keep = one_in(4);
  const bool may_change = plan.from_entries.contains("resources");
  if (one_in(may_change ? 2 : 8)) plan.on_change = "exchange";
  if (!plan.keep && one_in(10)) plan.on_change = "release";
  if (one_in(10)) plan.on_change = "keep";
  const std::size_t outside = std::exchange(next_pool_, place + 1);
  plan.children.push_back(child());
  next_pool_ = outside;
  return plan;
}

std::string TreeGenerator::written(const std::string& group) {
  std::vector<std::string> names;
  if (meaning(names_, group) == group) names.push_back(group);
  for (const auto& [name, outside] : names_) {
    if (outside == group && name != group) names.push_back(name);
  }
  return names.empty() ? group : pick(names);
}

Plan TreeGenerator::decorator(int depth) {
  if (has_pool_left() && one_in(3)) return use_resources([&] { return node(depth + 1); });
  Plan plan{.kind = pick(std::array{"Inverter", "ForceSuccess", "ForceFailure", "Repeat", "Repeat",
                                    "Retry", "Timeout", "Delay", "RunOnce", "Cooldown", "Rate",
                                    "KeepRunningUntilFailure", "SubTree", "SyncProgress",
                                    "SyncProgress", "SyncProgress", "SyncProgress"})};
  if (plan.kind == "SyncProgress") {
    plan.barrier = written(pick(barriers_));
  }
  plan.children.push_back(node(depth + 1));
  if (plan.kind == "Retry" || (plan.kind == "Repeat" && !one_in(4))) plan.times = between(1, 4);
  plan.seconds = .05 * between(plan.kind == "Timeout" ? 1 : 0, 20);
  const bool has_clock = plan.kind == "Timeout" || plan.kind == "Delay" || plan.kind == "Rate";
  plan.wall_clock = has_clock && one_in(3);
  return plan;
}

Trial random_trial(std::uint64_t seed) {
  return TreeGenerator(seed).trial();
}

}  // namespace lockstep::host::test

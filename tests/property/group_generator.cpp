#include "property/group_generator.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "property/plan_repair.h"

namespace lockstep::host::test {

Trial GroupGenerator::trial() {
  Trial trial;
  trial.is_document = true;
  budget_ = between(8, 36);
  faults_ = one_in(8);
  skips_ = one_in(2);
  scripts_ = !one_in(3);
  draw_groups();
  Plan tree = around(1);
  trial.plan = scripts_ ? with_entries(std::move(tree)) : std::move(tree);
  trial.plan.beside = groups_;
  take_out_lonely_members(trial.plan);
  take_out_unknown_readings(trial.plan);
  draw_times(trial);
  draw_writes(trial);
  return trial;
}

void GroupGenerator::draw_groups() {
  barriers_ = {"g0", "g0", "g0", "g1", "g1", "g2"};
  pools_ = {"p", "q", "r"};
  if (one_in(2)) resource_keys_ = {"r", "s"};
  for (const char* name : {"g0", "g1", "g2"}) {
    groups_.push_back(barrier(name));
    if (one_in(3)) take_from_entry(groups_.back());
  }
  for (const std::string& name : pools_) {
    groups_.push_back(pool(name));
    if (!resource_keys_.empty() || one_in(2)) groups_.back().resources = "A;B;C";
  }
  if (!resource_keys_.empty() && one_in(8)) assignments_.push_back("r:='D'");
  for (const std::string& key : resource_keys_) {
    for (const char* set : {"A", "B;C", "A;C", "any(B;A)", "C;any(A;B)"}) {
      assignments_.push_back(fmt::format("{}:='{}'", key, set));
    }
  }
}

// Its limit.
void GroupGenerator::take_from_entry(Plan& group) {
  const auto take = [&](const std::string& parameter, const std::string& key,
                        std::initializer_list<const char*> assignments) {
    group.from_entries[parameter] = key;
    keys_.push_back(key);
    assignments_.insert(assignments_.end(), assignments.begin(), assignments.end());
    if (key == "b" || !one_in(8)) return;
    assignments_.push_back(key == "w" ? "w:='never'" : key + ":=0-1");
  };
  if (group.has_barriers) {
    if (one_in(2)) take("at_barrier", "w", {"w:='tick'", "w:='wait'"});
    if (one_in(2)) take("barriers", "b", {});
  } else if (group.barrier_count >= 0) {
    take("barrier_count", "n", {"n:=0", "n:=1", "n:=4"});
  } else {
    take("delta", "d", {"d:=0.0", "d:=0.1", "d:=0.5", "d:=1.0"});
  }
}

void GroupGenerator::draw_writes(Trial& trial) {
  std::vector<std::string> keys = keys_;
  keys.insert(keys.end(), resource_keys_.begin(), resource_keys_.end());
  for (const std::string& key : keys) {
    trial.writes.push_back(write(one_in(8) ? between(1, 4) : 0, key));
  }
  if (keys.empty() || one_in(3)) return;
  for (int tick = 1; tick < trial.ticks; ++tick) {
    if (one_in(4)) trial.writes.push_back(write(tick, pick(keys)));
  }
}

EntryWrite GroupGenerator::write(int tick, const std::string& entry) {
  const bool is_wrong = one_in(100);
  if (entry == "d") return {tick, entry, is_wrong ? 2.0 : fraction()};
  if (entry == "n") return {tick, entry, static_cast<double>(is_wrong ? -1 : between(0, 5))};
  std::string text;
  if (entry == "w") {
    text = pick(std::array{"wait", "tick"});
  } else if (entry == "b") {
    text = pick(std::array{"0.5", "0.25;0.5;0.75", "0.1;0.9", "1", "0.3;0.6;1", "0", "0;0.5"});
  } else {
    text = pick(std::array{"A", "B", "A;B", "B;C", "A;B;C", "any(C;A)", "A;any(B;C)"});
  }
  return {tick, entry, is_wrong ? "-1" : text};
}

// Most of these begin the tree below them again, so that a barrier does, too.
Plan GroupGenerator::around(int depth) {
  if (one_in(2)) return common_ancestor(depth);
  Plan plan{.kind = pick(std::array{"Repeat", "Repeat", "Retry", "Sequence", "Fallback",
                                    "ForceSuccess", "KeepRunningUntilFailure", "SubTree"})};
  if (plan.kind == "SubTree") return subtree_on_way(depth);
  if (plan.kind == "Retry") plan.times = between(2, 9);
  const bool is_ordered = plan.kind == "Sequence" || plan.kind == "Fallback";
  plan.memory = is_ordered && one_in(2);
  if (is_ordered && one_in(2)) plan.children.push_back(guard(depth + 1));
  plan.children.push_back(common_ancestor(depth + 1));
  return plan;
}

Plan GroupGenerator::common_ancestor(int depth) {
  if (one_in(8)) return branches_on_way(depth);
  Plan plan{.kind = pick(std::array{"Parallel", "Parallel", "Parallel", "Parallel",
                                    "ParallelAbsolute", "ParallelRelative"})};
  for (int i = between(2, 4); i > 0; --i) {
    links_ = one_in(3) ? between(1, 3) : 0;
    plan.children.push_back(one_in(8) ? guard(depth + 1) : way(depth + 1));
  }
  links_ = 0;
  const Plan& last = plan.children.back();
  if (last.kind == "SubTree" && one_in(2)) {
    Plan copy = last;
    if (!copy.renames.contains("g0")) copy.renames["g0"] = written("g1");
    plan.children.push_back(std::move(copy));
  }
  ends_late(plan);
  return plan;
}

// A parallel that often goes on after a child has failed.
void GroupGenerator::ends_late(Plan& parallel) {
  const int children = static_cast<int>(parallel.children.size());
  parallel.forgets = one_in(8);
  if (!one_in(4)) parallel.failure_count = one_in(3) ? between(1, children) : children;
  if (!one_in(4)) parallel.success_count = between(1, children);
  if (parallel.kind == "ParallelRelative") {
    parallel.delta = fraction();
    parallel.holds_between = one_in(3);
  }
  if (parallel.kind == "ParallelAbsolute") barriers(parallel);
}

Plan GroupGenerator::node(int depth) {
  return budget_ > 0 && one_in(3) ? way(depth) : TreeGenerator::node(depth);
}

Plan GroupGenerator::way(int depth) {
  --budget_;
  if (links_ == 1) return links_ = 0, outliving_parallel();
  const bool is_last = depth >= kMaxDepth || budget_ <= 0 || one_in(3);
  if (is_last && links_ == 0) return member(depth);
  links_ = std::max(0, links_ - 1);
  Plan plan = node_on_way(depth);
  if (scripts_ && one_in(2)) add_hooks(plan);
  return plan;
}

Plan GroupGenerator::node_on_way(int depth) {
  switch (between(0, 9)) {
    case 0:
    case 1:
      return parallel_on_way(depth);
    case 2:
    case 3:
    case 4:
      if (has_pool_left() && one_in(3)) return row_of_pool_members(depth);
      return ordered_on_way(depth);
    case 5:
      return branches_on_way(depth);
    case 6:
      return subtree_on_way(depth);
    default:
      return decorator_on_way(depth);
  }
}

Plan GroupGenerator::member(int depth) {
  const bool is_last = depth >= kMaxDepth || budget_ <= 0;
  if (!is_last && has_pool_left() && one_in(3)) return pool_member(depth);
  Plan child = !is_last && one_in(4) ? way(depth + 1)
               : one_in(10)          ? guard(depth + 1)
               : one_in(2)           ? working_leaf()
                                     : TreeGenerator::node(std::max(depth + 1, kMaxDepth - 1));
  Plan plan = sync_progress(pick(barriers_), std::move(child));
  if (scripts_ && one_in(2)) add_hooks(plan);
  return plan;
}

Plan GroupGenerator::pool_member(int depth) {
  Plan plan = use_resources([&] { return one_in(2) ? way(depth + 1) : working_leaf(); });
  if (scripts_ && one_in(2)) add_hooks(plan);
  return plan;
}

// Members of one pool, one after the other.
Plan GroupGenerator::row_of_pool_members(int depth) {
  Plan plan{.kind = "Sequence", .memory = !one_in(4)};
  for (int i = between(2, 3); i > 0; --i) plan.children.push_back(pool_member(depth + 1));
  // The first one may be around members of any other.
  const auto of = [&](const Plan& it) { return meaning(names_, it.pool); };
  const std::string pool = std::ranges::min_element(plan.children, {}, of)->pool;
  for (Plan& it : plan.children) {
    it.pool = pool;
    if (one_in(2)) it.keep = it.on_change.empty();
  }
  return plan;
}

// It goes on after a member in it has failed, or has been halted.
Plan GroupGenerator::outliving_parallel() {
  Plan gone = sync_progress(pick(barriers_), working_leaf());
  gone.children[0].script = pick(std::array{"R0.30F", "R0.20R0.40F...", "R0.60R0.70F", "F"});
  if (one_in(3)) {
    gone = {.kind = pick(std::array{"ForceFailure", "RunOnce", "Timeout", "SubTree"}),
            .children = {std::move(gone)},
            .seconds = 2};
  }
  Plan plan{.kind = "Parallel", .children = {std::move(gone), working_leaf()}};
  if (one_in(2)) plan.children[1].script = "+0.05";
  plan.success_count = 1;
  plan.failure_count = 2;
  plan.forgets = one_in(8);
  if (scripts_ && one_in(6)) plan.hooks["while"] = condition();
  return plan;
}

Plan GroupGenerator::parallel_on_way(int depth) {
  Plan plan{.kind = pick(std::array{"Parallel", "Parallel", "Parallel", "ParallelAbsolute",
                                    "ParallelRelative"})};
  const int count = between(1, 3), place = between(0, count - 1);
  for (int i = 0; i < count; ++i) {
    plan.children.push_back(i == place  ? way(depth + 1)
                            : one_in(4) ? guard(depth + 1)
                                        : node(depth + 1));
  }
  ends_late(plan);
  return plan;
}

// Often with conditions alone before the member.
Plan GroupGenerator::ordered_on_way(int depth) {
  Plan plan{.kind = one_in(3) ? "Fallback" : "Sequence"};
  plan.memory = one_in(2);
  const bool has_conditions_only = one_in(2);
  for (int i = between(0, 2); i > 0; --i) {
    plan.children.push_back(has_conditions_only ? scripted("condition") : node(depth + 1));
  }
  plan.children.push_back(way(depth + 1));
  if (one_in(3)) plan.children.push_back(node(depth + 1));
  return plan;
}

Plan GroupGenerator::branches_on_way(int depth) {
  Plan plan{.kind = pick(std::array{"IfThenElse", "IfThenElse", "WhileDoElse", "Switch"})};
  if (plan.kind == "Switch") {
    plan.code = scripts_ ? pick(std::array{"x", "y", "x+y"}) : "1";
    plan.cases = {"0", "1"};
  } else {
    plan.children.push_back(one_in(2) ? way(depth + 1) : guard(depth + 1));
  }
  plan.children.push_back(node(depth + 1));
  plan.children.push_back(way(depth + 1));
  return plan;
}

Plan GroupGenerator::decorator_on_way(int depth) {
  Plan plan{.kind = pick(std::array{"Inverter", "ForceSuccess", "ForceFailure", "Repeat", "Retry",
                                    "Retry", "Timeout", "Delay", "RunOnce", "Cooldown", "Rate",
                                    "KeepRunningUntilFailure", "UseResources", "SyncProgress",
                                    "SyncProgress"})};
  if (plan.kind == "UseResources" && has_pool_left()) return pool_member(depth);
  if (plan.kind == "UseResources") plan.kind = "Inverter";
  if (plan.kind == "SyncProgress") plan.barrier = written(pick(barriers_));
  plan.children.push_back(way(depth + 1));
  if (plan.kind == "Retry" || (plan.kind == "Repeat" && !one_in(4))) plan.times = between(1, 4);
  plan.seconds = .05 * between(plan.kind == "Timeout" ? 1 : 0, 20);
  const bool has_clock = plan.kind == "Timeout" || plan.kind == "Delay" || plan.kind == "Rate";
  plan.wall_clock = has_clock && one_in(2);
  return plan;
}

// Inside, a barrier or two pools have other names.
Plan GroupGenerator::subtree_on_way(int depth) {
  Plan plan{.kind = "SubTree"};
  if (one_in(3)) {
    plan.renames = {{"p", written("q")}, {"q", written("p")}};
  } else if (!one_in(4)) {
    plan.renames = {{pick(std::array{"g0", "g1", "meet"}), written(pick(barriers_))}};
  }
  const GroupNames outside = std::exchange(names_, names_inside(plan, names_));
  plan.children.push_back(depth == 1 ? common_ancestor(depth + 1) : way(depth + 1));
  names_ = outside;
  return plan;
}

// An action whose progress rises until it ends.
Plan GroupGenerator::working_leaf() {
  std::string script;
  double progress = 0;
  do {
    progress = std::min(1.0, progress + pick(std::array{.05, .1, .2, .25, .3}));
    script += fmt::format("R{:.2f}", progress);
  } while (progress < .95 && !one_in(6));
  script += pick(std::array{"S", "S", "F", "F...", "S..."});
  return {.kind = "action", .name = fmt::format("a{}", leaves_++), .script = std::move(script)};
}

Trial random_group_trial(std::uint64_t seed) {
  return GroupGenerator(seed).trial();
}

}  // namespace lockstep::host::test

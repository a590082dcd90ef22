// Shrinks a trial: what a tree can do without.
#include <algorithm>

#include "property/random_tree.h"

namespace lockstep::host::test {
namespace {

// Its scripts need what its first child does.
bool gives_entries(const Plan& plan) {
  return !plan.children.empty() && plan.children[0].code == kStart;
}

// Each plan that comes from taking a child away or putting a child in its parent's place.
void add_smaller_plans(const Plan& plan, std::vector<Plan>& plans) {
  for (const auto& [attribute, script] : plan.hooks) {
    plans.push_back(plan);
    plans.back().hooks.erase(attribute);
  }
  for (const auto& [name, outside] : plan.renames) {
    plans.push_back(plan);
    plans.back().renames.erase(name);
  }
  for (std::size_t i = 0; i < plan.children.size(); ++i) {
    plans.push_back(plan.children[i]);
    const bool has_branches = plan.kind == "IfThenElse" || plan.kind == "WhileDoElse";
    if (plan.kind != "Switch" && plan.children.size() > (has_branches ? 2 : 1)) {
      Plan fewer = plan;
      fewer.children.erase(fewer.children.begin() + static_cast<std::ptrdiff_t>(i));
      const int left = static_cast<int>(fewer.children.size());
      fewer.success_count = std::min(fewer.success_count, left);
      fewer.failure_count = std::min(fewer.failure_count, left);
      plans.push_back(fewer);
    }
    std::vector<Plan> deeper;
    add_smaller_plans(plan.children[i], deeper);
    for (Plan& child : deeper) {
      Plan changed = plan;
      changed.children[i] = std::move(child);
      plans.push_back(std::move(changed));
    }
  }
}

// Without groups that have no members, and without each of the entries' values.
void add_fewer_groups(const Trial& trial, std::vector<Trial>& trials) {
  const std::vector<const Plan*> used = groups_of(trial.plan);
  if (used.size() == trial.plan.beside.size()) return;
  Trial fewer = trial;
  fewer.plan.beside.clear();
  for (const Plan* group : used) fewer.plan.beside.push_back(*group);
  trials.push_back(std::move(fewer));
}

void add_fewer_writes(const Trial& trial, std::vector<Trial>& trials) {
  for (std::size_t i = 0; i < trial.writes.size(); ++i) {
    trials.push_back(trial);
    std::vector<EntryWrite>& writes = trials.back().writes;
    writes.erase(writes.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace

std::vector<Trial> smaller_trials(const Trial& trial) {
  std::vector<Plan> plans;
  add_smaller_plans(trial.plan, plans);
  std::vector<Trial> trials;
  add_fewer_groups(trial, trials);
  for (Plan& plan : plans) {
    if (gives_entries(trial.plan) && !gives_entries(plan)) continue;
    plan.beside = trial.plan.beside;
    take_out_unknown_readings(plan);
    trials.push_back(trial);
    trials.back().plan = std::move(plan);
  }
  add_fewer_writes(trial, trials);
  if (trial.halt_every != 0) {
    trials.push_back(trial);
    trials.back().halt_every = 0;
  }
  return trials;
}

}  // namespace lockstep::host::test

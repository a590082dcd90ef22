#include "property/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace lockstep::test {
namespace {

std::string parameters(const Plan& plan) {
  std::string text;
  const auto add = [&text](std::string_view name, const auto& value) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, value);
  };
  if (plan.memory) add("memory", "true");
  if (plan.forgets) add("memory", "false");
  if (plan.success_count >= 0) add("success_count", plan.success_count);
  if (plan.failure_count >= 0) add("failure_count", plan.failure_count);
  if (plan.has_barriers) add("barriers", fmt::format("{}", fmt::join(plan.barriers, ";")));
  if (plan.barrier_count >= 0) add("barrier_count", plan.barrier_count);
  if (plan.tick_at_barrier) add("at_barrier", "tick");
  const bool is_delta = plan.kind == "barrier" && !plan.has_barriers && plan.barrier_count < 0;
  if (plan.kind == "ParallelRelative" || is_delta) add("delta", plan.delta);
  if (plan.ignores_idle) add("idle", "ignore");
  if (plan.kind == "barrier" || plan.kind == "resources") add("name", plan.name);
  if (plan.kind == "resources") add("increment", plan.increment);
  if (plan.kind == "UseResources") {
    add("pool", plan.pool);
    add("resources", plan.resources);
    if (plan.keep) add("keep", "true");
  }
  if (plan.kind == "SyncProgress") add("barrier", plan.barrier);
  if (plan.times >= 0) add(plan.kind == "Retry" ? "attempts" : "times", plan.times);
  constexpr std::array kTimed{"Wait", "Delay", "Timeout", "Cooldown", "Rate"};
  if (std::ranges::find(kTimed, plan.kind) != kTimed.end()) add("seconds", plan.seconds);
  if (plan.wall_clock) add("clock", "wall");
  const bool is_switch = plan.kind == "Switch";
  if (!plan.code.empty()) add(is_switch ? "on" : "code", plan.code);
  if (is_switch) add("cases", fmt::format("{}", fmt::join(plan.cases, ";")));
  for (const auto& [attribute, script] : plan.hooks) add(attribute, script);
  return text.empty() ? text : "[" + text + "]";
}

std::string node_text(const Plan& plan) {
  if (plan.kind == "action") return plan.name + parameters(plan);
  if (plan.kind == "condition") return plan.name + parameters(plan) + "?";
  if (plan.kind == "bare") return plan.name + "[bare]";
  std::string text = plan.kind + parameters(plan);
  if (plan.children.empty()) return text;
  text += '(';
  for (const Plan& child : plan.children) {
    if (text.back() != '(') text += ' ';
    text += node_text(child);
  }
  return text + ')';
}

bool has_member(const Plan& plan, std::string_view group) {
  return plan.barrier == group || plan.pool == group ||
         std::ranges::any_of(plan.children,
                             [&](const Plan& child) { return has_member(child, group); });
}

}  // namespace

std::vector<const Plan*> groups_of(const Plan& plan) {
  std::vector<const Plan*> used;
  for (const Plan& group : plan.beside) {
    if (has_member(plan, group.name)) used.push_back(&group);
  }
  return used;
}

std::string tree_text(const Plan& plan) {
  std::string text = node_text(plan);
  for (const Plan* group : groups_of(plan)) text += ' ' + node_text(*group);
  return text;
}

std::string leaves_text(const Plan& plan) {
  if (!plan.script.empty()) {
    return plan.name + (plan.script[0] == '+' ? "" : "=") + plan.script;
  }
  std::string text;
  for (const Plan& child : plan.children) {
    const std::string leaves = leaves_text(child);
    if (!text.empty() && !leaves.empty()) text += ' ';
    text += leaves;
  }
  return text;
}

bool is_guard(const Plan& plan) {
  if (plan.children.empty()) return plan.kind == "condition" || plan.kind == "Check";
  return std::ranges::all_of(plan.children, is_guard);
}

std::size_t count_nodes(const Plan& plan) {
  std::size_t count = 1;
  for (const Plan& child : plan.children) count += count_nodes(child);
  return count;
}

}  // namespace lockstep::test

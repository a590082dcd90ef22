#include "property/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "engine/node_kind.h"

namespace lockstep::host::test {
namespace {

// Those of one node, as written in a document.
class AttributeList {
 public:
  explicit AttributeList(const Plan& plan) : plan_(plan) {
    add_control();
    if (plan.kind == "barrier") add_barrier();
    add_group();
    add_others();
    for (const auto& [attribute, script] : plan.hooks) add(attribute, script);
  }
  Attributes list;

 private:
  template <class Value>
  void add(const std::string& name, const Value& value) {
    const auto key = plan_.from_entries.find(name);
    const bool is_entry = key != plan_.from_entries.end();
    list.emplace_back(name, is_entry ? "{" + key->second + "}" : fmt::format("{}", value));
  }

  void add_control() {
    if (plan_.memory) add("memory", "true");
    if (plan_.forgets) add("memory", "false");
    if (plan_.kind != "barrier") add_pace();
    if (plan_.success_count >= 0) add("success_count", plan_.success_count);
    if (plan_.failure_count >= 0) add("failure_count", plan_.failure_count);
    if (plan_.has_barriers) add("barriers", fmt::format("{}", fmt::join(plan_.barriers, ";")));
    if (plan_.barrier_count >= 0) add("barrier_count", plan_.barrier_count);
    const bool may_tick = plan_.tick_at_barrier || plan_.from_entries.contains("at_barrier");
    if (may_tick) add("at_barrier", "tick");
    if (plan_.kind == "ParallelRelative") add("delta", plan_.delta);
    if (plan_.holds_between) add("hold", "between");
  }

  void add_pace() {
    if (!plan_.pace) return;
    add("pace", "true");
    add("reaction", plan_.reaction);
  }

  void add_barrier() {
    if (!plan_.has_barriers && plan_.barrier_count < 0) add("delta", plan_.delta);
    if (plan_.ignores_idle) add("idle", "ignore");
    add_pace();
  }

  void add_group() {
    if (plan_.kind == "barrier" || plan_.kind == "resources") add("name", plan_.name);
    if (plan_.kind == "resources") add("increment", plan_.increment);
    if (plan_.kind == "UseResources") add("pool", plan_.pool);
    const bool has_names = !plan_.resources.empty() || plan_.from_entries.contains("resources");
    if (has_names) add("resources", plan_.resources);
    if (plan_.keep) add("keep", "true");
    if (!plan_.on_change.empty()) add("on_change", plan_.on_change);
    if (plan_.from_entries.contains("granted")) add("granted", "");
    if (plan_.kind == "SyncProgress") add("barrier", plan_.barrier);
  }

  void add_others() {
    if (plan_.times >= 0) add(plan_.kind == "Retry" ? "attempts" : "times", plan_.times);
    if (has_parameter("seconds")) add("seconds", plan_.seconds);
    if (plan_.kind == "Ask") add("text", "Now?");
    if (!plan_.fallback.empty()) add("default", plan_.fallback);
    if ((plan_.kind == "WaitUntil" || plan_.kind == "Ask") && plan_.seconds > 0)
      add("timeout", plan_.seconds);
    if (plan_.wall_clock) add("clock", "wall");
    const bool is_switch = plan_.kind == "Switch";
    if (!plan_.code.empty()) add(is_switch ? "on" : "code", plan_.code);
    if (is_switch) add("cases", fmt::format("{}", fmt::join(plan_.cases, ";")));
    if (!plan_.output.empty()) list.emplace_back("out", "{" + plan_.output + "}");
  }

  bool has_parameter(std::string_view name) const {
    return std::ranges::any_of(built_in_kinds(), [&](const NodeKind* it) {
      return it->type.id == plan_.kind &&
             std::ranges::count(it->type.parameters, name, &Parameter::name) == 1;
    });
  }

  const Plan& plan_;
};

std::string parameters(const Plan& plan) {
  std::string text;
  for (const auto& [name, value] : attributes_of(plan)) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, value);
  }
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

// `names`: of the groups, inside of the SubTrees around `plan`.
bool has_member(const Plan& plan, const std::string& group, const GroupNames& names) {
  const GroupNames inside = names_inside(plan, names);
  return (!plan.barrier.empty() && meaning(names, plan.barrier) == group) ||
         (!plan.pool.empty() && meaning(names, plan.pool) == group) ||
         std::ranges::any_of(plan.children,
                             [&](const Plan& child) { return has_member(child, group, inside); });
}

}  // namespace

Attributes attributes_of(const Plan& plan) {
  return AttributeList(plan).list;
}

std::string meaning(const GroupNames& names, const std::string& name) {
  const auto other = names.find(name);
  return other == names.end() ? name : other->second;
}

GroupNames names_inside(const Plan& plan, const GroupNames& names) {
  GroupNames inside = names;
  for (const auto& [name, outside] : plan.renames) inside[name] = meaning(names, outside);
  return inside;
}

std::vector<const Plan*> groups_of(const Plan& plan) {
  std::vector<const Plan*> used;
  for (const Plan& group : plan.beside) {
    if (has_member(plan, group.name, {})) used.push_back(&group);
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

// Such as r:='any(A;B)': it reads nothing.
static bool is_assignment(const std::string& script) {
  return script.find(":=") != std::string::npos;
}

std::vector<std::string> readings_in(const Plan& plan) {
  std::vector<std::string> scripts{plan.code}, found;
  for (const auto& [attribute, script] : plan.hooks) scripts.push_back(script);
  for (const std::string& script : scripts) {
    const auto close = script.find(')');
    if (close != std::string::npos && !is_assignment(script))
      found.push_back(script.substr(0, close + 1));
  }
  return found;
}

namespace {

// A leaf whose name another one has, in a copy of its SubTree, comes twice.
using Readable = std::multiset<std::string>;

void collect_readable(const Plan& plan, const GroupNames& names, Readable& all) {
  if (!plan.script.empty()) all.insert(plan.name);
  const std::string pool = meaning(names, plan.pool);
  for (const char* name : {"A", "B", "C"}) {
    if (!pool.empty() && plan.resources.find(name) != std::string::npos &&
        !plan.from_entries.contains("resources")) {
      all.insert(pool + "/" + name);
    }
  }
  const GroupNames inside = names_inside(plan, names);
  for (const Plan& child : plan.children) collect_readable(child, inside, all);
}

void replace_readings(Plan& plan, const Readable& readable) {
  const auto repair = [&](std::string& script) {
    const auto open = script.find('('), close = script.find(')');
    if (close == std::string::npos || is_assignment(script)) return;
    const std::string name = script.substr(open + 1, close - open - 1);
    const bool is_resource = name.find('/') != std::string::npos;
    const auto count = readable.count(name);
    if (count == 0 || (count > 1 && !is_resource)) script = "1>0";
  };
  repair(plan.code);
  for (auto& [attribute, script] : plan.hooks) repair(script);
  for (Plan& child : plan.children) replace_readings(child, readable);
}

}  // namespace

void take_out_unknown_readings(Plan& plan) {
  Readable readable;
  collect_readable(plan, {}, readable);
  replace_readings(plan, readable);
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

}  // namespace lockstep::host::test

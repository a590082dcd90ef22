#include <fmt/format.h>

#include "base/core/hook.h"
#include "base/core/parameter_value.h"
#include "base/core/wording.h"
#include "describe/node_reference.h"
#include "leaves/declared.h"

namespace lockstep::host {

std::span<const NodeGroup> node_groups() {
  static constexpr NodeGroup kGroups[] = {{NodeCategory::Control, "Control nodes"},
                                          {NodeCategory::Decorator, "Decorators"},
                                          {NodeCategory::SubTree, "Subtrees"},
                                          {NodeCategory::Action, "Actions"},
                                          {NodeCategory::Condition, "Conditions"},
                                          {NodeCategory::Group, "Outside the trees, in root"}};
  return kGroups;
}

std::span<const CommonAttribute> common_attributes() {
  static constexpr CommonAttribute kCommon[] = {
      {"name",
       "The name of the node in messages, views and recordings; default: its id. Without "
       "'/'."},
      {"_description", "A remark for readers of the file."}};
  return kCommon;
}

std::span<const CommonAttribute> script_attributes() {
  static constexpr CommonAttribute kScripts[] = {
      {"failure_if",
       "A script that is evaluated when an activation begins. True: a Failure, without a tick."},
      {"success_if", "The same; true: a Success."},
      {"skip_if", "The same; true: skipped, as if the node were not there in this tick."},
      {"while",
       "A script that is evaluated before each tick. False: the node is halted and skipped."},
      {"on_success", "A script that runs when the node has succeeded."},
      {"on_failure", "A script that runs when it has failed."},
      {"on_end", "A script that runs when it has succeeded or failed, after those."},
      {"on_halt", "A script that runs when it was halted."}};
  static_assert(std::size(kScripts) == kHooks);
  return kScripts;
}

std::span<const CommonAttribute> action_attributes() {
  static constexpr CommonAttribute kAction[] = {
      {"on_resume",
       "restart, failure or success: what the action does that ran when its process was cut, and "
       "that cannot continue. Default: as `run --on-resume` has it."},
      {"commit",
       "true: the action runs until a checkpoint with its Success is on the disk. Default: "
       "false."}};
  return kAction;
}

std::span<const CommonAttribute> subtree_attributes() {
  static constexpr CommonAttribute kSubTree[] = {
      {"ID", "The BehaviorTree to insert here; required."},
      {"_autoremap",
       "true: a key without an attribute is the key of the same name outside; false by "
       "default."},
      {"KEY",
       "Any other attribute KEY: the entry {KEY} inside is the entry {key} outside, or starts "
       "with the given text."}};
  return kSubTree;
}

std::string children_text(const NodeType& type) {
  if (type.arity.max == 0 || type.category == NodeCategory::SubTree) return "no children";
  return arity_text(type.arity.min, type.arity.max);
}

std::string facts_text(const Parameter& parameter) {
  std::string text(parameter.is_template  ? "text"
                   : parameter.is_script  ? "script"
                   : parameter.is_generic ? "any type"
                                          : type_name(parameter.type, parameter.object));
  if (!parameter.group.empty()) text = fmt::format("the name of a {}", parameter.name);
  if (!parameter.unit.empty()) text += fmt::format(" in {}", parameter.unit);
  if (parameter.direction != Direction::Input) {
    text += fmt::format(", {}put to a blackboard entry", to_string(parameter.direction));
  }
  if (!parameter.choices.empty()) text += fmt::format(", {}", joined(parameter.choices, " or "));
  const std::string range = range_text(parameter.range);
  if (!range.empty()) text += ", " + range;
  if (parameter.default_text) {
    text += fmt::format(", default {}",
                        parameter.default_text->empty() ? "empty" : *parameter.default_text);
  } else if (!parameter.default_key.empty()) {
    text += fmt::format(", default {{{}}}", parameter.default_key);
  } else {
    text += parameter.required ? ", required" : ", optional";
  }
  if (parameter.is_template) text += ", with the value of an entry for each {key}";
  if (parameter.constant || (parameter.is_script && !parameter.is_template)) {
    text += ", never a {key}";
  }
  return text;
}

std::string behavior_text(const NodeType& type) {
  std::string text;
  for (const Statement& it : declared_behavior(type)) {
    text += fmt::format("{}{}=\"{}\"", text.empty() ? "" : " ", it.word, it.value);
  }
  return text;
}

std::string usage_text(const NodeType& type) {
  std::string text = fmt::format("<{}", type.id);
  if (type.category == NodeCategory::SubTree) text += " ID=\"…\"";
  if (type.category == NodeCategory::Group) text += " name=\"…\"";
  for (const Parameter& parameter : type.parameters) {
    if (!parameter.required) continue;
    const bool is_key = parameter.direction != Direction::Input;
    text += fmt::format(" {}=\"{}\"", parameter.name, is_key ? "{…}" : "…");
  }
  if (type.arity.max == 0 || type.category == NodeCategory::SubTree) return text + "/>";
  return text + fmt::format("> … </{}>", type.id);
}

}  // namespace lockstep::host

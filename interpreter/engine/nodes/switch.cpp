#include <algorithm>

#include "base/core/wording.h"
#include "engine/node_context.h"
#include "engine/node_scripts.h"
#include "engine/nodes/fold.h"
#include "engine/nodes/kinds.h"
#include "language/expression/equal.h"

namespace lockstep::host {
namespace {

constexpr unsigned kOn = 0, kCases = 1;

constexpr Parameter kSwitchParameters[] = {
    {.name = "on",
     .type = ValueType::String,
     .doc = "What the cases are compared with, in every tick.",
     .required = true,
     .is_script = true},
    {.name = "cases",
     .type = ValueType::StringList,
     .doc = "The value that chooses the first child, the second, and so on: dock;drive. One child "
            "more is for all other values.",
     .required = true,
     .constant = true},
};

std::optional<RuleBreak> rule_of_switch(const ParameterValues& given) {
  const auto* cases = std::get_if<std::vector<std::string>>(&given.values[kCases]);
  if (cases == nullptr || given.children == 0) return std::nullopt;
  for (auto it = cases->begin(); it != cases->end(); ++it) {
    if (std::find(cases->begin(), it, *it) == it) continue;
    return RuleBreak{static_cast<int>(kCases), "the case '" + brief(*it) + "' is given twice", ""};
  }
  const std::size_t count = cases->size();
  if (given.children == count || given.children == count + 1) return std::nullopt;
  return RuleBreak{static_cast<int>(kCases),
                   std::to_string(count) + (count == 1 ? " case" : " cases") + " for " +
                       std::to_string(given.children) +
                       (given.children == 1 ? " child" : " children"),
                   "give each child a case, in order; one child more is for all other values"};
}

struct SwitchState {
  NodeIndex current;  // the child that was chosen last; 0: none
};

// The child of the first case that is equal, else the one after the cases; 0: there is none.
NodeIndex choose(NodeContext& context, NodeIndex self, const Value& value) {
  NodeIndex child = self + 1;
  for (const std::string& text : context.parameters().texts(self, kCases)) {
    if (equals_text(value, text)) return child;
    child = context.end_of(child);
  }
  return child == context.end_of(self) ? 0 : child;
}

Status tick_switch(NodeContext& context, NodeIndex self) {
  SwitchState& state = context.state<SwitchState>(self);
  if (context.first_tick(self)) state.current = 0;
  const Value* value = context.scripts().value_of(self, kOn);
  if (value == nullptr) return Status::Failure;
  const NodeIndex child = choose(context, self, *value);
  if (state.current != 0 && state.current != child) context.halt(state.current);
  state.current = child;
  return child == 0 ? Status::Failure : context.tick(child);
}

double progress_of_switch(NodeContext& context, NodeIndex self) {
  const NodeIndex child = context.state<SwitchState>(self).current;
  return child == 0 ? 0.0 : context.progress(child);
}

}  // namespace

const NodeKind kSwitch{
    .type = {.id = "Switch",
             .category = NodeCategory::Control,
             .doc = "Ticks the child of the first case that equals a value, otherwise the child "
                    "after those of the cases; Failure if there is none. When the value chooses "
                    "another child, the one that runs is halted.",
             .arity = {1},
             .parameters = kSwitchParameters,
             .rule = rule_of_switch},
    .tick = tick_switch,
    .progress = progress_of_switch,
    .state_size = sizeof(SwitchState),
    .fold = fold::dead_when_idle,
    .if_moved = IfMoved::FromChild};

}  // namespace lockstep::host

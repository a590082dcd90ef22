// Script, Check and, for BehaviorTree.CPP, ScriptCondition: leaves that run a script.
#include "engine/node_context.h"
#include "engine/nodes/at_once.h"
#include "engine/nodes/kinds.h"

namespace lockstep {
namespace {

constexpr unsigned kCode = 0;

constexpr Parameter kScriptParameters[] = {{.name = "code",
                                            .type = ValueType::String,
                                            .doc = "What to run; its value does not count.",
                                            .required = true,
                                            .is_script = true}};
constexpr Parameter kCheckParameters[] = {{.name = "code",
                                           .type = ValueType::String,
                                           .doc = "What decides between Success and Failure.",
                                           .required = true,
                                           .is_script = true}};

Status tick_script(NodeContext& context, NodeIndex self) {
  const bool good = context.run_script(self, context.script(self, kCode), "code");
  return good ? Status::Success : Status::Failure;
}

Status tick_check(NodeContext& context, NodeIndex self) {
  const auto holds = context.holds(self, context.script(self, kCode), "code");
  return holds.value_or(false) ? Status::Success : Status::Failure;
}

constexpr NodeKind check_kind(std::string_view id) {
  return {.type = {.id = id,
                   .category = NodeCategory::Condition,
                   .doc = "Success when its script is true, else Failure.",
                   .arity = {0, 0},
                   .parameters = kCheckParameters},
          .tick = tick_check,
          .progress = no_progress};
}

}  // namespace

const NodeKind kScript{.type = {.id = "Script",
                                .category = NodeCategory::Action,
                                .doc = "Runs a script over the entries, and succeeds.",
                                .arity = {0, 0},
                                .parameters = kScriptParameters},
                       .tick = tick_script,
                       .progress = no_progress};

const NodeKind kCheck = check_kind("Check");
const NodeKind btcpp::kScriptCondition = check_kind("ScriptCondition");

}  // namespace lockstep

#include "support/scripted_types.h"

#include <vector>

#include "support/scripted_leaf.h"

namespace lockstep::host::test {
namespace {

const std::vector<Parameter> kOutputs{
    {.name = "out", .type = ValueType::Int, .doc = "", .direction = Direction::Output},
    {.name = "flag", .type = ValueType::Bool, .doc = "", .direction = Direction::Output}};

}  // namespace

const NodeType kScriptedActionType{.id = "Scripted",
                                   .category = NodeCategory::Action,
                                   .doc = "",
                                   .arity = {0, 0},
                                   .can_run = true,
                                   .can_be_slowed = true,
                                   .leaf = &kScriptedAction};
const NodeType kScriptedConditionType{.id = "ScriptedCondition",
                                      .category = NodeCategory::Condition,
                                      .doc = "",
                                      .arity = {0, 0},
                                      .leaf = &kScriptedCondition};
const NodeType kWritingActionType{.id = "Writing",
                                  .category = NodeCategory::Action,
                                  .doc = "",
                                  .arity = {0, 0},
                                  .parameters = kOutputs,
                                  .can_run = true,
                                  .leaf = &kScriptedAction};
const NodeType kWritingConditionType{.id = "WritingCondition",
                                     .category = NodeCategory::Condition,
                                     .doc = "",
                                     .arity = {0, 0},
                                     .parameters = kOutputs,
                                     .leaf = &kScriptedCondition};
const NodeType kBareActionType{.id = "Bare",
                               .category = NodeCategory::Action,
                               .doc = "",
                               .arity = {0, 0},
                               .can_run = true,
                               .has_progress = false,
                               .leaf = &kBareAction};
const NodeType kStartlessActionType{.id = "Startless",
                                    .category = NodeCategory::Action,
                                    .doc = "",
                                    .arity = {0, 0},
                                    .can_run = true,
                                    .leaf = &kStartlessAction};

}  // namespace lockstep::host::test

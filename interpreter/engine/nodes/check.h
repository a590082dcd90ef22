// A condition that asks a script, under the name that it has in a language.
#pragma once

#include "engine/node_context.h"
#include "engine/node_scripts.h"
#include "engine/nodes/at_once.h"

namespace lockstep::host::check {

inline constexpr unsigned kCode = 0;

inline constexpr Parameter kParameters[] = {{.name = "code",
                                             .type = ValueType::String,
                                             .doc = "What decides between Success and Failure.",
                                             .required = true,
                                             .is_script = true}};

inline Status tick(NodeContext& context, NodeIndex self) {
  const auto holds = context.scripts().holds(self, kCode);
  return holds.value_or(false) ? Status::Success : Status::Failure;
}

constexpr NodeKind kind(std::string_view id) {
  return {.type = {.id = id,
                   .category = NodeCategory::Condition,
                   .doc = "Success when its script is true, otherwise Failure.",
                   .arity = {0, 0},
                   .parameters = kParameters},
          .tick = tick,
          .progress = no_progress};
}

}  // namespace lockstep::host::check

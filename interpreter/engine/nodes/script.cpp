// Script and Check: leaves that run a script.
#include "engine/node_context.h"
#include "engine/node_scripts.h"
#include "engine/nodes/at_once.h"
#include "engine/nodes/check.h"
#include "engine/nodes/kinds.h"

namespace lockstep::host {
namespace {

constexpr unsigned kCode = 0;

constexpr Parameter kScriptParameters[] = {{.name = "code",
                                            .type = ValueType::String,
                                            .doc = "What to run; its value does not count.",
                                            .required = true,
                                            .is_script = true}};

Status tick_script(NodeContext& context, NodeIndex self) {
  const bool good = context.scripts().run(self, kCode);
  return good ? Status::Success : Status::Failure;
}

}  // namespace

const NodeKind kScript{.type = {.id = "Script",
                                .category = NodeCategory::Action,
                                .doc = "Runs a script over the entries, and succeeds.",
                                .arity = {0, 0},
                                .parameters = kScriptParameters},
                       .tick = tick_script,
                       .progress = no_progress};

const NodeKind kCheck = check::kind("Check");

}  // namespace lockstep::host

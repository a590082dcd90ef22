// The scripts of nodes: attributes of every node, and ports that are scripts.
#pragma once

#include <memory>
#include <optional>

#include "definition/attributes.h"
#include "definition/checked_tree.h"
#include "document/reporter.h"

namespace lockstep::btcpp {

enum class EmptyScript : bool { IsRefused, DoesNothing };

// Nothing after an error, which is reported; null for an empty script that does nothing.
std::optional<std::shared_ptr<const Expression>> parse_script(const Attribute& attribute,
                                                              const Reporter& report,
                                                              EmptyScript empty);

// Appends the scripts of a node to `trees`.
void check_hooks(const NodeElement& element, const Reporter& report, CheckedNode& node,
                 CheckedTrees& trees);

}  // namespace lockstep::btcpp

// The scripts of nodes: attributes of every node, and parameters that are scripts.
#pragma once

#include "language/document/reporter.h"
#include "tree/check/attributes.h"
#include "tree/checked_tree.h"

namespace lockstep::host {

enum class EmptyScript : bool { IsRefused, DoesNothing };

// The script of a parameter. False after an error, which is reported.
bool read_script(const Attribute& attribute, const Reporter& report, const Parameter& parameter,
                 EmptyScript empty, CheckedPort& port, CheckedTrees& trees);

// What the attributes of an action say of a cut: LeafAtCut.
void check_at_cut(const NodeElement& element, const Reporter& report, CheckedNode& node,
                  const LanguageRules& rules);

// Appends the scripts around the ticks of a node to `trees`.
void check_hooks(const NodeElement& element, const Reporter& report, CheckedNode& node,
                 CheckedTrees& trees);

}  // namespace lockstep::host

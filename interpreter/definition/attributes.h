// The attributes of one node element as typed values: every rule about a single node's parameters.
#pragma once

#include "definition/checked_tree.h"
#include "document/reporter.h"

namespace lockstep {

// Checks the attributes of `node` (whose type, element and children are known) against its type and
// appends its values or ports to `trees`. `explicit_form`: its ID attribute names the type.
void check_attributes(const Document& document, const Reporter& report, bool explicit_form,
                      CheckedNode& node, CheckedTrees& trees);

// The same for a SubTree, whose attributes are a remapping.
void check_subtree_attributes(const Document& document, const Reporter& report, CheckedNode& node);

// Whether an attribute is one that every node may have: name, _description.
bool is_common_attribute(std::string_view name);

// "parameters of 'X': 'a', 'b', 'c'" for a hint.
std::string parameters_hint(const NodeType& type);

}  // namespace lockstep

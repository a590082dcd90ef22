// The attributes of one node element as typed values: every rule about a single node's parameters.
#pragma once

#include <span>

#include "language/document/element.h"
#include "language/document/reporter.h"
#include "tree/check/attribute_layout.h"
#include "tree/checked_tree.h"

namespace lockstep::host {

// Checks the attributes of `node` (whose type and children are known) against its type and appends
// its values or ports to `trees`.
void check_attributes(const NodeElement& element, const Reporter& report, CheckedNode& node,
                      AttributeLayouts& layouts, CheckedTrees& trees);

// The rule of its type about the parameters of `node`, as a part of check_attributes. What follows
// from values that entries give follows during the run, so it is not filled in here.
void check_rule(const NodeElement& element, const Reporter& report, const CheckedNode& node,
                std::span<const CheckedPort> ports, std::span<Value> values);

// Says that the text of an attribute is no value of `parameter`, or one that it refuses. Of a list
// of numbers, all that is wrong with it.
void report_no_value(const Attribute& attribute, const Reporter& report, const NodeType& type,
                     const Parameter& parameter);
void report_refusal(const Attribute& attribute, const Reporter& report, const NodeType& type,
                    const Parameter& parameter, const RuleBreak& refused);

// The same for a SubTree, whose attributes are remappings.
void check_subtree_attributes(const NodeElement& element, const Reporter& report, CheckedNode& node,
                              CheckedSubTree& subtree, CheckedTrees& trees);

// Appends the attributes as written to `trees`, for drawings.
void keep_written(const NodeElement& element, CheckedNode& node, CheckedTrees& trees);

// "parameters of 'X': 'a', 'b', 'c'" for a hint.
std::string parameters_hint(const NodeType& type);

}  // namespace lockstep::host

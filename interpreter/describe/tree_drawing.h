// A definition as a drawing: lines for a terminal, Graphviz, Mermaid. For `lockstep show`; prints
// nothing.
#pragma once

#include <string>
#include <vector>

#include "tree/definition.h"

namespace lockstep::host {

// Lines of box-drawing characters, or of ASCII.
std::string tree_as_text(const Definition& definition, bool ascii);
std::string tree_as_dot(const Definition& definition);
std::string tree_as_mermaid(const Definition& definition);

// Shared by the functions above.

// name="value" as the node is written, with arguments substituted; without what names the node.
std::vector<std::string> shown_attributes(const Definition& definition, const DefinitionNode& node);
// The lines that stand in a node's shape: the sign that papers use for its kind, or its id; its
// name when it has one; barriers or delta; its attributes.
std::vector<std::string> shown_lines(const Definition& definition, const DefinitionNode& node);

}  // namespace lockstep::host

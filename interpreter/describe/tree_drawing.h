// A definition as a drawing: lines for a terminal, Graphviz, Mermaid. For `lockstep show`; prints
// nothing.
#pragma once

#include <string>
#include <vector>

#include "definition/definition.h"
#include "document/project.h"

namespace lockstep {

struct Drawn {
  const Project& project;
  const Definition& definition;
};

// Lines of box-drawing characters, or of ASCII.
std::string tree_as_text(const Drawn& drawn, bool ascii);
std::string tree_as_dot(const Drawn& drawn);
std::string tree_as_mermaid(const Drawn& drawn);

// What is shared by the above.

// name="value" of the node's element, with arguments substituted; without what names the node.
std::vector<std::string> shown_attributes(const Drawn& drawn, const DefinitionNode& node);
// The lines that stand in a node's shape: the sign that papers use for its kind, or its id; its
// name when it has one; barriers or delta; its attributes.
std::vector<std::string> shown_lines(const Drawn& drawn, const DefinitionNode& node);

}  // namespace lockstep

// The Shape of a compiled tree, with all entries; and what those who read a recording, which has no
// tree, need to know of the engine.
#pragma once

#include <cstddef>
#include <vector>

#include "trace/shape.h"

namespace lockstep::host {

struct LanguageRules;
struct Tree;

Shape shape_of(const Tree& tree);
// What a node asks a person; nothing: it is no such node.
std::optional<NodeQuestion> question_of(const Tree& tree, NodeIndex node);

// What the Shape has of a kind.
void add_facts(const NodeType& type, ShapeNode& node);

// The built-in kinds of a language.
std::vector<const NodeType*> built_in_types(const LanguageRules& rules);

// How much there is within a tick at most, of a tree of so many nodes: Moment::within.
struct MostWithin {
  std::size_t moments, changes, progress;
};
MostWithin most_within(std::size_t nodes);

}  // namespace lockstep::host

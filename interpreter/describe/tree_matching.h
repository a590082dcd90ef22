// Which node of one tree is which node of another one. The way of GumTree (Falleri and others,
// "Fine-grained and accurate source code differencing", 2014), with names and paths of nodes: first
// equal subtrees from the top, then nodes with the same names, then those around what is matched,
// from below, and last what is left among the children of nodes that are matched.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tree/definition.h"

namespace lockstep::host {

// An attribute, or a parameter that has a value without one.
struct NodeValue {
  std::string_view name;
  std::string text;        // its meaning: "5" for 5.0, a script without blanks
  std::string shown = {};  // as written, with arguments substituted
  bool is_written = true;
};

std::vector<NodeValue> values_of(const Definition& definition, const DefinitionNode& node);
// Whether it has a name of its own, and not that of its kind or its tree.
bool is_named(const Definition& definition, const DefinitionNode& node);

struct MatchedTree {
  explicit MatchedTree(const Definition& definition);

  const DefinitionNode& node(std::uint32_t index) const { return definition.nodes[index]; }
  std::uint32_t size(std::uint32_t index) const { return node(index).end - index; }
  bool is_top(std::uint32_t index) const { return node(index).parent == index; }

  const Definition& definition;
  std::vector<std::string> paths;
  std::vector<std::uint64_t> own, whole;  // hashes of a node, and with all below it
};

inline constexpr std::uint32_t kNoNode = 0xffffffff;

struct Matching {
  std::vector<std::uint32_t> to_new, to_old;  // by index
};

Matching match(const MatchedTree& old_tree, const MatchedTree& new_tree);

}  // namespace lockstep::host

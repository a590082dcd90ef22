// What a project says before subtrees are expanded: each element of each BehaviorTree with its node
// type and its attributes as values. Between resolve.cpp's two passes; nobody else uses it.
#pragma once

#include <map>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "definition/catalog.h"
#include "document/project.h"

namespace lockstep {

// A parameter of a node: a constant, a {key} with its default, or absent.
struct CheckedPort {
  std::uint32_t value = 0xffffffff;  // in CheckedTrees::values
  std::string_view key;
};

struct CheckedNode {
  const NodeType* type = nullptr;
  std::string_view name;
  std::uint32_t document = 0;
  std::uint32_t element = 0;
  std::uint32_t end = 0;  // in CheckedTrees::nodes
  std::uint32_t children = 0;
  std::uint32_t first = 0;        // in CheckedTrees::ports
  std::string_view subtree = {};  // the ID that a SubTree names
};

// A SubTree that names a tree, and where in its own tree it stands.
struct CheckedReference {
  std::uint32_t node;
  std::uint32_t depth;      // below the root
  std::uint64_t path_size;  // bytes of its path, from the root on
};

// One BehaviorTree, its subtrees not expanded.
struct CheckedTree {
  std::uint32_t root;                                 // in CheckedTrees::nodes
  std::uint32_t first_reference = 0, references = 0;  // in CheckedTrees::references
  std::uint32_t depth = 0;                            // levels
  std::uint64_t paths_size = 0;  // bytes of the paths of all its nodes, from the root on
};

struct CheckedTrees {
  std::vector<CheckedNode> nodes;
  std::vector<Value> values;
  std::vector<CheckedPort> ports;
  std::vector<CheckedReference> references;
  std::map<std::string_view, CheckedTree> trees;  // by the ID of the BehaviorTree
  std::vector<std::string_view> ids;              // as they stand in the documents
};

// Checks every BehaviorTree of the project, used or not.
CheckedTrees check_trees(const Project& project, const Catalog& catalog, Diagnostics& diagnostics);

// "key" when `text` is "{key}", else "".
std::string_view key_of(std::string_view text);

}  // namespace lockstep

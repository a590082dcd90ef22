// Types for nodes that neither the language nor a plugin has, so that a tree can be checked and
// tried before its plugins exist.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>

#include "language/document/project.h"
#include "language/document/reporter.h"
#include "tree/catalog.h"
#include "tree/check/models.h"

namespace lockstep::host {

enum class MissingNodes : unsigned char {
  AreErrors,
  AreNoted,  // if the language of the tree says so
  AreMocked
};

// By ID; these are mocked even if a plugin has them.
using Mocks = std::map<std::string, Mock, std::less<>>;
// What stand-ins write, as text, by "port" or "ID.port".
using MockOutputs = std::map<std::string, std::string, std::less<>>;

// The IDs of BehaviorTrees.
using TreeIds = std::set<std::string, std::less<>>;

// Owns the types that it adds to a catalog.
class StandIns;

// Adds to `catalog` the types of the nodes of `project` that it does not have: from a model, or
// from how the trees use them. A tree that is not in the project has one as well, by its ID. Null:
// there are none.
std::shared_ptr<const StandIns> add_stand_ins(const Project& project, const Models& models,
                                              MissingNodes unknown, const Mocks& mocks,
                                              const MockOutputs& outputs, const TreeIds& elsewhere,
                                              Catalog& catalog, const Reporter& report);

// The type in place of the tree that a SubTree with these attributes names; null: there is none.
const NodeType* stand_in_for_tree(std::span<const Attribute> attributes, const Catalog& catalog);

}  // namespace lockstep::host

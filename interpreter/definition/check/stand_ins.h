// Types for nodes that neither the language nor a plugin has, so that a tree can be checked and
// tried before its plugins exist.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "definition/catalog.h"
#include "definition/check/models.h"
#include "document/project.h"
#include "document/reporter.h"

namespace lockstep::host {

enum class MissingNodes : unsigned char {
  AreErrors,
  AreNoted,  // if the language of the tree says so
  AreMocked
};

// By ID; these are mocked even if a plugin has them.
using Mocks = std::map<std::string, Mock, std::less<>>;

// Owns the types that it adds to a catalog.
class StandIns;

// Adds to `catalog` the types of the nodes of `project` that it does not have: from a model, or
// from how the trees use them. Null: there are none.
std::shared_ptr<const StandIns> add_stand_ins(const Project& project, const Models& models,
                                              MissingNodes unknown, const Mocks& mocks,
                                              Catalog& catalog, const Reporter& report);

}  // namespace lockstep::host

// Project + Catalog -> Definition: checks every rule about trees. Reports all errors in one pass.
#pragma once

#include <optional>
#include <string>

#include "base/core/diagnostics.h"
#include "language/document/project.h"
#include "tree/catalog.h"
#include "tree/check/stand_ins.h"
#include "tree/definition.h"
#include "tree/expand/expand.h"

namespace lockstep::host {

struct ResolveOptions {
  std::string main_tree;  // "": main_tree_to_execute, or the only
  StartValues values;
  StartValues later = {};  // texts of entries that get a value while the tree runs
  MissingNodes unknown = MissingNodes::AreErrors;
  Mocks mocks = {};
  MockOutputs mock_outputs = {};
  bool opens_entries = false;  // the program uses entries by their names
  bool has_outside = false;    // "@key" is none of the main tree, but of a board of the program
  // A file of trees for others, or of models, is only checked: resolve() then returns nothing.
  bool may_lack_main = false;
  bool is_part = false;    // of a file that includes it: its only tree is not the main tree
  TreeIds elsewhere = {};  // trees of files that this one does not include
};

// Returns nothing if there are errors, or no main tree. Also reports warnings and notes.
std::optional<Definition> resolve(const Project& project, const Catalog& catalog,
                                  const ResolveOptions& options, Diagnostics& diagnostics);

}  // namespace lockstep::host

// How the documents of a language are read: what a language hands in beside its rules.
#pragma once

#include <string_view>
#include <vector>

#include "base/core/diagnostics.h"
#include "language/document/project.h"
#include "tree/catalog.h"
#include "tree/check/foreign_hints.h"
#include "tree/check/models.h"
#include "tree/checked_tree.h"

namespace lockstep::host {

struct LanguageReader {
  // Checks every BehaviorTree of the project, used or not.
  CheckedTrees (*read)(const Project& project, const Catalog& catalog, const Models& models,
                       Diagnostics& diagnostics);
  // Whether a node had this name in another version of the language. May be null.
  bool (*is_old_name)(std::string_view id) = nullptr;
  // Those that this version still reads where a file says that it is older. May be null.
  std::vector<std::string_view> (*old_names)(const Document& document) = nullptr;
  // For those who use its words in another language. May be null.
  const ForeignHints* hints = nullptr;
};

}  // namespace lockstep::host

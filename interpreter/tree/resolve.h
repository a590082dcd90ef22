// Project + Catalog -> Definition: checks every rule about trees. Reports all errors in one pass.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/core/diagnostics.h"
#include "language/document/project.h"
#include "language/document/reporter.h"
#include "tree/catalog.h"
#include "tree/check/models.h"
#include "tree/check/stand_ins.h"
#include "tree/checked_tree.h"
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
  bool is_advised = true;  // false: who asks needs no warnings about a tree that has no error
};

// The trees of a project, checked once, of which each may then be expanded as the main one.
class TreesOfProject {
 public:
  // All must outlive it.
  TreesOfProject(const Project& project, const Catalog& catalog, ResolveOptions options,
                 Diagnostics& diagnostics);

  // Of the main tree; once, and last. See resolve().
  std::optional<Definition> main();
  // Calls `use` with the definition of a tree, which ends with the call. The first one has the
  // properties of the main file. Returns false after an error, or if there is no such tree.
  bool use(std::string_view id, const std::function<void(const Definition&)>& use);

 private:
  std::optional<std::string_view> choose_main() const;
  Definition expanded(std::string_view id);
  bool finish(Definition& definition) const;

  const Project& project_;
  const ResolveOptions options_;
  const Reporter report_;
  const Models models_;
  Catalog known_;
  const std::shared_ptr<const StandIns> stand_ins_;
  CheckedTrees trees_;
  std::optional<std::string_view> main_;
  bool is_expandable_ = false;
};

// Returns nothing if there are errors, or no main tree. Also reports warnings and notes.
std::optional<Definition> resolve(const Project& project, const Catalog& catalog,
                                  const ResolveOptions& options, Diagnostics& diagnostics);

}  // namespace lockstep::host

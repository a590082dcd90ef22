// A tree document through the whole pipeline, in this process, with the plugins 'robot' and
// 'motion': what is wrong with it, what its nodes are called, and what a run of it does.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/core/diagnostics.h"
#include "engine/tree.h"
#include "language/document/project.h"
#include "run/loading/plugin_set.h"
#include "tree/definition.h"

namespace lockstep::host::test {

// A claim of the pages of the language. A text that is not a whole document stands in one, in line
// 2, as the tree 'T'. `options`: "tree=Main arg.speed=1 set.key=x".
struct ClaimRow {
  std::string_view claim;
  std::string_view xml;
  std::string_view expected;
  std::string_view options = {};
};

// All that is told of the document, sorted, a line each: "2:7 error: unknown node 'Sequnce'".
void check_told(std::span<const ClaimRow> rows);
// The status, the tick in which the run ended, counted from 1, and what the leaves said:
// "success 3: hello, bye". After 100 ticks it is "running".
void check_runs(std::span<const ClaimRow> rows);
// The paths of the nodes, in pre-order, separated by blanks.
void check_paths(std::span<const ClaimRow> rows);

class Pipeline {
 public:
  explicit Pipeline(std::string_view xml, std::string_view options = {},
                    const std::string& path = "tree.xml");

  bool loaded() const { return tree_.has_value(); }
  const Tree& tree() const { return *tree_; }
  const Diagnostics& diagnostics() const { return diagnostics_; }
  // Adds what `check` says after it has searched the behaviors of the tree for deadlocks.
  void advise();
  std::string told() const;
  std::string run() const;
  std::string paths() const;

 private:
  Diagnostics diagnostics_;
  std::unique_ptr<Project> project_;
  PluginSet plugins_;
  std::optional<Definition> definition_;
  std::optional<Tree> tree_;
};

}  // namespace lockstep::host::test

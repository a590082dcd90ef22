#include "cli/run/progress_notes.h"

#include <fmt/format.h>

#include <vector>

#include "base/core/wording.h"
#include "engine/synchronized.h"

namespace lockstep::host {
namespace {

// The leaf below the decorators of a child: it gives the child its progress. Null if there is a
// control node.
const NodeLabel* source_of(const Tree& tree, NodeIndex child) {
  const auto category = [&] { return tree.labels[child].type->category; };
  while (tree.nodes[child].children == 1 && category() != NodeCategory::Control) ++child;
  return category() == NodeCategory::Action ? &tree.labels[child] : nullptr;
}

std::string leaves_without_progress(const Tree& tree, NodeIndex keeper) {
  std::vector<std::string_view> names;
  for_each_child(tree, keeper, [&](NodeIndex child) {
    const NodeLabel* leaf = source_of(tree, child);
    if (leaf != nullptr && !leaf->type->has_progress) names.push_back(leaf->name);
  });
  return names.empty() ? "" : listed(names);
}

}  // namespace

void note_leaves_without_progress(const Tree& tree, const std::string& file,
                                  Diagnostics& diagnostics) {
  for (const NodeIndex keeper : synchronized_nodes(tree)) {
    if (!compares_progress(synchronization(tree.nodes[keeper]))) continue;
    const std::string names = leaves_without_progress(tree, keeper);
    if (names.empty()) continue;
    diagnostics.note("no-progress"_code, {file},
                     fmt::format("the children of '{}' are in step, but these report no "
                                 "progress and are at 0 until they succeed: {}",
                                 tree.path(keeper), names),
                     "the others wait for them at the first barrier, or within delta of 0");
  }
}

}  // namespace lockstep::host

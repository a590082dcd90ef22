#include "cli/tools/study/study_out_of_range.h"

#include <fmt/format.h>

#include "base/core/wording.h"
#include "trace/progress_text.h"

namespace lockstep::host {

void StudyOutOfRangeCount::add(const StudyOutOfRange& found) {
  const Tree& tree = study_.cells[found.row.cell].tree;
  Leaf& leaf = leaves_.try_emplace(tree.path(found.progress.node), Leaf{found}).first->second;
  ++leaf.runs;
}

void StudyOutOfRangeCount::add_to(Diagnostics& diagnostics) const {
  for (const auto& [path, leaf] : leaves_) {
    const auto& [row, progress] = leaf.first;
    const NodeType& type = *study_.cells[row.cell].tree.labels[progress.node].type;
    diagnostics.warning("bad-progress"_code, {study_.plan.tree_file},
                        fmt::format("the leaf '{}' ({} of plugin '{}') {}", path, type.id,
                                    type.plugin, out_of_range_text(progress.reported)),
                        fmt::format("first in run {} of cell {}; in {} in all", row.run, row.cell,
                                    counted(leaf.runs, "run")));
  }
}

}  // namespace lockstep::host

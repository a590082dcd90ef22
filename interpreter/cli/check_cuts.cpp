#include "cli/check_cuts.h"

#include <fmt/format.h>

#include <vector>

#include "base/core/diagnostics.h"
#include "base/terminal/text_table.h"
#include "engine/compile.h"
#include "run/checkpoint/run_bytes.h"
#include "team/team_run.h"

namespace lockstep::host {
namespace {

std::string_view what_it_does(AfterCut does) {
  switch (does) {
    case AfterCut::Success:
      return "counts as succeeded";
    case AfterCut::Failure:
      return "counts as failed";
    case AfterCut::StartsAgain:
    case AfterCut::Continues:
      break;
  }
  return "starts again";
}

std::string text_of(const LeafNode& leaf) {
  std::string text(leaf.type->can_be_restored ? "continues, if it can"
                                              : what_it_does(leaf.at_cut.unasked({})));
  if (leaf.at_cut.commits) text += "; its success counts when it is on the disk";
  return text;
}

}  // namespace

std::string cuts_text(const Definition& definition) {
  const Tree tree = compile(definition);
  if (const auto entry = entry_for_objects(tree)) {
    return fmt::format(
        "  nothing continues: the entry '{}' holds objects, which no checkpoint has\n",
        printable(*entry));
  }
  if (const auto why_not = why_not_kept(tree)) {
    return fmt::format("  nothing continues: {}, {}\n", why_not->message, why_not->hint);
  }
  std::vector<TableRow> rows;
  NodeIndex end = 0;  // what is below a node of a plugin starts with it
  for (const LeafNode& leaf : tree.leaves) {
    const bool is_below = leaf.node < end;
    if (!is_below) end = tree.nodes[leaf.node].end;
    if (!leaf.type->can_run && leaf.children == 0) continue;
    rows.push_back({"  " + printable(tree.path(leaf.node)), printable(std::string(leaf.type->id)),
                    stands_for_robots(*leaf.type) ? "waits for what the other robots send"
                    : is_below                    ? "starts again with the node above it"
                                                  : text_of(leaf)});
  }
  if (rows.empty()) return "  all of it continues after a cut\n";
  return "  after a cut, built-in nodes continue, and of others:\n" + text_table(rows, 3);
}

}  // namespace lockstep::host

#include "run/cut_text.h"

#include <fmt/format.h>

#include <map>
#include <vector>

#include "base/core/diagnostics.h"
#include "base/core/wording.h"
#include "tree/expand/robots.h"

namespace lockstep::host {
namespace {

// "starts again", of one leaf, or of several.
std::string_view what_it_does(const CutLeaf& leaf, bool is_one) {
  switch (leaf.does) {
    case AfterCut::StartsAgain:
      return is_one ? "starts again" : "start again";
    case AfterCut::Continues:
      return is_one ? "continues" : "continue";
    case AfterCut::Success:
      return is_one ? "counts as succeeded" : "count as succeeded";
    case AfterCut::Failure:
      break;
  }
  if (leaf.is_asked) return "cannot continue";
  return is_one ? "counts as failed" : "count as failed";
}

}  // namespace

std::string what_leaves_do(std::span<const CutLeaf> cut, const Tree& tree) {
  std::map<std::string_view, std::vector<std::string>> paths;  // by what one of them does
  std::map<std::string_view, std::string_view> of_several;
  std::string text;
  for (const CutLeaf& leaf : cut) {
    const NodeIndex node = tree.leaves[leaf.place].node;
    const std::string path = tree.path(node);
    const std::string_view type = tree.leaves[leaf.place].type->id;
    if (type == kTeamMember || type == kTeamResources) continue;  // other robots do it
    if (leaf.does == AfterCut::Continues) {
      text += fmt::format("; '{}' {} at {:.2g}", path, what_it_does(leaf, true), leaf.progress);
    } else {
      of_several[what_it_does(leaf, true)] = what_it_does(leaf, false);
      paths[what_it_does(leaf, true)].push_back(path);
    }
  }
  for (const auto& [what, of] : paths) {
    const std::vector<std::string_view> names(of.begin(), of.end());
    text += fmt::format("; {} {}", listed(names), of.size() == 1 ? what : of_several[what]);
  }
  return printable(text);
}

std::string cut_text(std::span<const CutLeaf> cut, const Tree& tree) {
  return "cut: the process ends here and is resumed" + what_leaves_do(cut, tree);
}

}  // namespace lockstep::host

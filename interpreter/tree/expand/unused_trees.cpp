#include "tree/expand/unused_trees.h"

#include <set>
#include <span>
#include <utility>

#include "tree/expand/expand.h"

namespace lockstep::host {
namespace {

std::span<const CheckedSubTree> subtrees_of(const CheckedTrees& trees, std::string_view id) {
  const auto tree = trees.trees.find(id);
  if (tree == trees.trees.end()) return {};
  return std::span(trees.subtrees).subspan(tree->second.first_subtree, tree->second.subtrees);
}

void add_used(const CheckedTrees& trees, std::string_view id, std::set<std::string_view>& used) {
  if (!used.insert(id).second) return;
  for (const CheckedSubTree& it : subtrees_of(trees, id)) add_used(trees, it.id, used);
}

}  // namespace

void check_unused(CheckedTrees& trees, std::string_view main, const Reporter& report) {
  std::set<std::string_view> used;
  add_used(trees, main, used);
  std::set<std::string_view> inside;  // of other unused ones: checked with these
  for (const std::string_view id : trees.ids) {
    if (used.contains(id)) continue;
    for (const CheckedSubTree& it : subtrees_of(trees, id)) inside.insert(it.id);
  }
  for (const std::string_view id : trees.ids) {
    if (used.contains(id) || inside.contains(id)) continue;
    take_back(trees, expand(trees, id, {}, report, Expansion::OfPart));
  }
}

}  // namespace lockstep::host

#include "tree/check/named_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/pre_order.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

// That the root names, or the only one; "" if there is none.
std::string_view main_tree_of(const Document& document, const CheckedTrees& trees) {
  if (const Attribute* main = document.find_attribute(0, "main_tree_to_execute")) {
    return main->value;
  }
  const auto elements = document.elements();
  std::string_view only;
  int count = 0;
  for (const std::uint32_t child : children_in(elements, 0)) {
    if (elements[child].tag != "BehaviorTree" || ++count > 1) continue;
    if (const Attribute* id = document.find_attribute(child, "ID")) {
      only = id->value;
      continue;
    }
    const auto found = std::ranges::find_if(trees.trees, [&](const auto& tree) {
      return trees.nodes[tree.second.root].place.byte == elements[child + 1].place.byte;
    });
    if (found != trees.trees.end()) only = found->first;
  }
  return count == 1 ? only : std::string_view();
}

}  // namespace

void add_named_files(const Project& project, CheckedTrees& trees, const Reporter& report) {
  for (const Project::NamedFile& file : project.named) {
    if (trees.trees.contains(file.name)) {
      report.at_value("duplicate-tree"_code, file.place,
                      fmt::format("a tree '{}' exists already", brief(file.name)),
                      "a file that is included stands for its main tree: give it another name");
      continue;
    }
    const auto main = trees.trees.find(main_tree_of(*project.documents[file.document], trees));
    if (main == trees.trees.end()) continue;
    trees.trees.emplace(file.name, main->second);
    trees.ids.push_back(file.name);
  }
}

std::string hint_for_second_tree(const Sources& sources, Place first, Place second) {
  const std::string hint = fmt::format("the first is at {}", to_text(sources.locate(first)));
  if (&sources.of(first) == &sources.of(second)) return hint;
  return hint + "; <include path=\"…\" as=\"NAME\"/> keeps the trees of a file apart: NAME.ID";
}

}  // namespace lockstep::host

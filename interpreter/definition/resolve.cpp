#include "definition/resolve.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/suggest.h"
#include "core/wording.h"
#include "definition/attributes.h"
#include "definition/expand.h"
#include "definition/references.h"
#include "document/reporter.h"

namespace lockstep {
namespace {

// The ID of the tree to run; nothing after an error.
std::optional<std::string_view> choose_main(const Project& project, const CheckedTrees& trees,
                                            const ResolveOptions& options,
                                            Diagnostics& diagnostics) {
  const Document& main = *project.documents.front();
  const Reporter report(main, diagnostics);
  if (trees.ids.empty()) {
    // Else it is there, but without an ID, or this is no tree file at all: reported already.
    if (trees.nodes.empty() && main.elements()[0].tag == "root") {
      report.at_element(0, "there is no BehaviorTree", "put a <BehaviorTree ID=\"…\"> into <root>");
    }
    return std::nullopt;
  }
  if (!options.main_tree.empty()) {
    const auto it = trees.trees.find(options.main_tree);
    if (it != trees.trees.end()) return it->first;
    diagnostics.error({}, fmt::format("--tree {}: unknown tree", options.main_tree),
                      suggest(options.main_tree, trees.ids, "trees in this project"));
    return std::nullopt;
  }
  if (const Attribute* attribute = main.find_attribute(0, "main_tree_to_execute")) {
    const auto it = trees.trees.find(attribute->value);
    if (it != trees.trees.end()) return it->first;
    report.at_value(0, "main_tree_to_execute",
                    fmt::format("unknown tree '{}'", brief(attribute->value)),
                    suggest(attribute->value, trees.ids, "trees in this project"));
    return std::nullopt;
  }
  if (trees.ids.size() == 1) return trees.ids.front();
  report.at_element(
      0, "it is not said which tree to run",
      fmt::format("add main_tree_to_execute=\"…\" or give --tree; trees: {}", listed(trees.ids)));
  return std::nullopt;
}

}  // namespace

std::optional<Definition> resolve(const Project& project, const Catalog& catalog,
                                  const ResolveOptions& options, Diagnostics& diagnostics) {
  CheckedTrees trees = check_trees(project, catalog, diagnostics);
  const auto main = choose_main(project, trees, options, diagnostics);
  if (!check_references(project, trees, diagnostics) || !main) return std::nullopt;
  Definition definition = expand(project, trees, *main, options, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  advise(project, definition, diagnostics);
  return definition;
}

}  // namespace lockstep

#include "definition/resolve.h"

#include <fmt/format.h>

#include "core/audience.h"
#include "core/suggest.h"
#include "core/wording.h"
#include "definition/advise/advise.h"
#include "definition/advise/group_advice.h"
#include "definition/check/references.h"
#include "definition/expand/groups.h"
#include "definition/expand/resources.h"
#include "definition/expand/unused_trees.h"
#include "definition/language_reader.h"
#include "document/reporter.h"

namespace lockstep::host {
namespace {

// The ID of the tree to run; nothing after an error.
std::optional<std::string_view> choose_main(const CheckedTrees& trees, std::string_view given,
                                            const Reporter& report) {
  const auto& main = trees.main;
  if (trees.ids.empty()) {
    // Else it is there, but without an ID, or this is no tree file at all: reported already.
    if (trees.nodes.empty() && main) {
      report.at(main->place, "there is no BehaviorTree",
                "put a <BehaviorTree ID=\"…\"> into <root>");
    }
    return std::nullopt;
  }
  if (!given.empty()) {
    const auto it = trees.trees.find(given);
    if (it != trees.trees.end()) return it->first;
    report.nowhere(worded(fmt::format("--tree {}: unknown tree", given),
                          fmt::format("unknown tree '{}'", given)),
                   suggest(given, trees.ids, "trees in this project"));
    return std::nullopt;
  }
  if (main->tree) {
    const auto it = trees.trees.find(*main->tree);
    if (it != trees.trees.end()) return it->first;
    report.at_value(main->tree_place, fmt::format("unknown tree '{}'", brief(*main->tree)),
                    suggest(*main->tree, trees.ids, "trees in this project"));
    return std::nullopt;
  }
  if (trees.ids.size() == 1) return trees.ids.front();
  report.at(main->place, "several trees, and none is chosen",
            fmt::format("add main_tree_to_execute=\"…\" or {}; trees: {}",
                        worded("use --tree", "choose one for the project"), listed(trees.ids)));
  return std::nullopt;
}

}  // namespace

std::optional<Definition> resolve(const Project& project, const Catalog& catalog,
                                  const ResolveOptions& options, Diagnostics& diagnostics) {
  const Reporter report(project.sources, diagnostics);
  const LanguageRules& rules = *project.rules;
  const bool has_models = rules.may_lack_nodes || options.unknown == MissingNodes::AreMocked;
  const auto models = has_models ? read_models(project, report) : Models();
  Catalog known = catalog;
  const auto stand_ins =
      add_stand_ins(project, models, options.unknown, options.mocks, known, report);
  CheckedTrees trees = rules.reader->read(project, known, models, diagnostics);
  trees.names_at_run_time |= options.opens_entries;
  trees.shares_entries |= options.opens_entries;
  trees.has_outside = options.has_outside;
  const auto main = choose_main(trees, options.main_tree, report);
  if (!check_references(trees, report) || !main) return std::nullopt;
  Definition definition = expand(trees, *main, options.values, report);
  definition.stand_ins = stand_ins;
  if (rules.checks_unused_trees) check_unused(trees, *main, report);
  resolve_resources(definition, report);
  if (report.has_errors()) return std::nullopt;
  check_groups(definition, report);
  if (report.has_errors()) return std::nullopt;
  advise(definition, report);
  advise_holds(definition, report);
  advise_resources(definition, report);
  warn_of_circle(definition, report);
  warn_of_keepers(definition, report);
  note_idle_members(definition, report);
  note_unfairness(definition, report);
  return definition;
}

}  // namespace lockstep::host

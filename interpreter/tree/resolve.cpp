#include "tree/resolve.h"

#include <fmt/format.h>

#include "base/core/audience.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "language/document/reporter.h"
#include "tree/advise/advise.h"
#include "tree/advise/group_advice.h"
#include "tree/check/references.h"
#include "tree/expand/groups.h"
#include "tree/expand/readings.h"
#include "tree/expand/resources.h"
#include "tree/expand/robots.h"
#include "tree/expand/unused_trees.h"
#include "tree/language_reader.h"

namespace lockstep::host {
namespace {

// The ID of the tree to run; nothing after an error, or if the file may be without one.
std::optional<std::string_view> choose_main(const CheckedTrees& trees, bool has_content,
                                            const ResolveOptions& options, const Reporter& report) {
  const auto& main = trees.main;
  const std::string_view given = options.main_tree;
  if (trees.ids.empty()) {
    // Else it is there, but without an ID, or this is no tree file at all: reported already.
    if (trees.nodes.empty() && main && options.may_lack_main && has_content) {
      report.at("no-tree"_code, main->place, "the file has no BehaviorTree", {}, Severity::Note);
    } else if (trees.nodes.empty() && main) {
      report.at("no-tree"_code, main->place, "there is no BehaviorTree",
                "put a <BehaviorTree ID=\"…\"> into <root>");
    }
    return std::nullopt;
  }
  if (!given.empty()) {
    const auto it = trees.trees.find(given);
    if (it != trees.trees.end()) return it->first;
    report.nowhere("unknown-tree"_code,
                   worded(fmt::format("--tree {}: unknown tree", given),
                          fmt::format("unknown tree '{}'", given)),
                   suggest(given, trees.ids, "trees in this project"));
    return std::nullopt;
  }
  if (main->tree && !(main->is_only && options.is_part)) {
    const auto it = trees.trees.find(*main->tree);
    if (it != trees.trees.end()) return it->first;
    if (options.may_lack_main && options.elsewhere.contains(*main->tree)) {
      report.at_value("tree-elsewhere"_code, main->tree_place,
                      fmt::format("the main tree '{}' is in another file", brief(*main->tree)),
                      "each tree of this one is checked alone", Severity::Note);
      return std::nullopt;
    }
    report.at_value("unknown-tree"_code, main->tree_place,
                    fmt::format("unknown tree '{}'", brief(*main->tree)),
                    suggest(*main->tree, trees.ids, "trees in this project"));
    return std::nullopt;
  }
  if (trees.ids.size() == 1 && !options.is_part) return trees.ids.front();
  if (options.may_lack_main) {
    report.at("no-main-tree"_code, main->place,
              "this file names no main tree: each of its trees is checked alone",
              "--tree chooses one", Severity::Note);
    return std::nullopt;
  }
  report.at("no-main-tree"_code, main->place, "several trees, and none is chosen",
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
  const auto stand_ins = add_stand_ins(project, models, options.unknown, options.mocks,
                                       options.mock_outputs, options.elsewhere, known, report);
  CheckedTrees trees = rules.reader->read(project, known, models, diagnostics);
  trees.names_at_run_time |= options.opens_entries;
  trees.shares_entries |= options.opens_entries;
  trees.has_outside = options.has_outside;
  trees.team_member = known.find(kTeamMember);
  trees.team_resources = known.find(kTeamResources);
  const bool has_content = project.documents.front()->elements().size() > 1;
  const auto main = choose_main(trees, has_content, options, report);
  std::vector<std::string_view> others(options.elsewhere.begin(), options.elsewhere.end());
  others.insert(others.end(), project.library_trees.begin(), project.library_trees.end());
  const bool is_expandable = check_references(trees, report, std::move(others));
  if (is_expandable && !main && options.may_lack_main) check_unused(trees, {}, report);
  if (!is_expandable || !main) return std::nullopt;
  Definition definition =
      expand(trees, *main, options.values, report, Expansion::OfMain, options.later);
  definition.stand_ins = stand_ins;
  definition.properties = std::move(trees.properties);
  if (rules.checks_unused_trees) {
    trees.values = definition.values;
    check_unused(trees, *main, report);
  }
  resolve_resources(definition, report);
  resolve_readings(definition, report);
  if (report.has_errors()) return std::nullopt;
  check_groups(definition, report);
  if (report.has_errors()) return std::nullopt;
  mark_slowed(definition);
  advise(definition, report);
  advise_holds(definition, report);
  advise_resources(definition, report);
  note_openings(definition, report);
  note_unfairness(definition, report);
  note_handovers(definition, report);
  note_unused_holds(definition, report);
  advise_paces(definition, report);
  return definition;
}

}  // namespace lockstep::host

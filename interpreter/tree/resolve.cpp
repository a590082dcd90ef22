#include "tree/resolve.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

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

bool has_models(const Project& project, const ResolveOptions& options) {
  return project.rules->may_lack_nodes || options.unknown == MissingNodes::AreMocked;
}

}  // namespace

TreesOfProject::TreesOfProject(const Project& project, const Catalog& catalog,
                               ResolveOptions options, Diagnostics& diagnostics)
    : project_(project),
      options_(std::move(options)),
      report_(project.sources, diagnostics),
      models_(has_models(project, options_) ? read_models(project, report_) : Models()),
      known_(catalog),
      stand_ins_(add_stand_ins(project, models_, options_.unknown, options_.mocks,
                               options_.mock_outputs, options_.elsewhere, known_, report_)),
      trees_(project.rules->reader->read(project, known_, models_, diagnostics)) {
  trees_.names_at_run_time |= options_.opens_entries;
  trees_.shares_entries |= options_.opens_entries;
  trees_.has_outside = options_.has_outside;
  trees_.team_member = known_.find(kTeamMember);
  trees_.team_resources = known_.find(kTeamResources);
  main_ = choose_main();
  std::vector<std::string_view> others(options_.elsewhere.begin(), options_.elsewhere.end());
  others.insert(others.end(), project.library_trees.begin(), project.library_trees.end());
  is_expandable_ = check_references(trees_, report_, std::move(others));
}

// The ID of the tree to run; nothing after an error, or if the file may be without one.
std::optional<std::string_view> TreesOfProject::choose_main() const {
  const CheckedTrees& trees = trees_;
  const ResolveOptions& options = options_;
  const Reporter& report = report_;
  const bool has_content = project_.documents.front()->elements().size() > 1;
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

Definition TreesOfProject::expanded(std::string_view id) {
  Definition definition =
      expand(trees_, id, options_.values, report_, Expansion::OfMain, options_.later);
  definition.stand_ins = stand_ins_;
  definition.properties = std::move(trees_.properties);
  trees_.properties.clear();
  return definition;
}

bool TreesOfProject::finish(Definition& definition) const {
  resolve_resources(definition, report_);
  resolve_readings(definition, report_);
  if (report_.has_errors()) return false;
  check_groups(definition, report_);
  if (report_.has_errors()) return false;
  mark_slowed(definition);
  return true;
}

bool TreesOfProject::use(std::string_view id, const std::function<void(const Definition&)>& use) {
  const auto tree = trees_.trees.find(id);
  if (!is_expandable_ || tree == trees_.trees.end()) return false;
  Definition definition = expanded(tree->first);
  const bool is_correct = finish(definition);
  if (is_correct) use(definition);
  take_back(trees_, std::move(definition));
  return is_correct;
}

std::optional<Definition> TreesOfProject::main() {
  if (is_expandable_ && !main_ && options_.may_lack_main) check_unused(trees_, {}, report_);
  if (!is_expandable_ || !main_) return std::nullopt;
  Definition definition = expanded(*main_);
  if (project_.rules->checks_unused_trees) {
    trees_.values = definition.values;
    check_unused(trees_, *main_, report_);
  }
  if (!finish(definition)) return std::nullopt;
  if (!options_.is_advised) return definition;
  advise(definition, report_);
  advise_holds(definition, report_);
  advise_resources(definition, report_);
  note_openings(definition, report_);
  note_unfairness(definition, report_);
  note_handovers(definition, report_);
  note_unused_holds(definition, report_);
  advise_paces(definition, report_);
  return definition;
}

std::optional<Definition> resolve(const Project& project, const Catalog& catalog,
                                  const ResolveOptions& options, Diagnostics& diagnostics) {
  return TreesOfProject(project, catalog, options, diagnostics).main();
}

}  // namespace lockstep::host

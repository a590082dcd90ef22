#include "verify/check/advice.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/compile.h"
#include "language/document/reporter.h"
#include "leaves/play/played_leaves.h"
#include "tree/pace.h"

namespace lockstep::host {

void add_advice(const Project& project, Definition definition, AdviceEffort effort,
                Diagnostics& diagnostics, std::function<int()> stop_signal) {
  const bool is_certain = effort == AdviceEffort::Certain && project.arguments.empty();
  if (!is_certain) effort = std::min(effort, AdviceEffort::Deadlocks);
  std::vector<Place> places;
  for (const DefinitionNode& node : definition.nodes) places.push_back(node.place);
  PlayedLeaves played;
  played.take_over(definition);
  ignore_pace(definition);
  const Tree tree = compile(definition);
  const Reporter reporter(project.sources, diagnostics);
  for (Advice& it : advice_of(tree, places, effort, std::move(stop_signal))) {
    reporter.at(it.code, places[it.node], std::move(it.message), std::move(it.hint), it.severity);
  }
}

void add_advice_of_run(const Project& project, const Definition& definition,
                       Diagnostics& diagnostics) {
  const bool holds = std::ranges::any_of(definition.nodes, [](const DefinitionNode& node) {
    return compares_progress(node.type->synchronization);
  });
  if (holds) add_advice(project, definition, AdviceEffort::Run, diagnostics);
}

}  // namespace lockstep::host

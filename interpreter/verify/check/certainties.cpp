#include "verify/check/certainties.h"

#include <utility>
#include <vector>

#include "engine/compile.h"
#include "language/document/reporter.h"
#include "leaves/play/played_leaves.h"
#include "verify/certain.h"

namespace lockstep::host {

void add_certainties(const Project& project, Definition definition, Diagnostics& diagnostics,
                     std::function<int()> stop_signal) {
  if (!project.arguments.empty()) return;
  std::vector<Place> places;
  for (const DefinitionNode& node : definition.nodes) places.push_back(node.place);
  PlayedLeaves played;
  played.take_over(definition);
  const Tree tree = compile(definition);
  const Reporter reporter(project.sources, diagnostics);
  for (Certainty& it : certainties_of(tree, places, std::move(stop_signal))) {
    reporter.at(places[it.node], std::move(it.message), std::move(it.hint), it.severity);
  }
}

}  // namespace lockstep::host

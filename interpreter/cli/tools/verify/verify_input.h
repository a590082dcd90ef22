// What `lockstep verify` reads besides trees, and where their nodes are.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "language/document/reporter.h"
#include "leaves/models.h"
#include "run/loading/load.h"

namespace lockstep::host {

// The places of the nodes, and what needs them: the documents go with this.
class Places {
 public:
  explicit Places(const Loaded& loaded) : sources_(loaded.project->sources) {
    for (const DefinitionNode& node : loaded.definition.nodes) places_.push_back(node.place);
  }
  std::string text(NodeIndex node) const { return to_text(sources_.locate(places_[node])); }
  void report(const std::vector<NodeProblem>& problems, Diagnostics& diagnostics) const {
    const Reporter reporter(sources_, diagnostics);
    for (const NodeProblem& it : problems)
      reporter.at("bad-leaf-model"_code, places_[it.node], it.message, it.hint);
  }

 private:
  const Sources sources_;
  std::vector<Place> places_;
};

// Null: none is named. Nothing: it cannot be used, which is reported.
std::optional<std::unique_ptr<LeafFile>> read_leaves(const std::string& path, std::string& as_text,
                                                     Diagnostics& diagnostics);

}  // namespace lockstep::host

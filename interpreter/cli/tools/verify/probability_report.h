// Probabilities as `lockstep verify --probability` prints them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "language/property/property.h"
#include "verify/costs.h"
#include "verify/probability.h"

namespace lockstep::host {

struct ProbabilityReport {
  const ChanceGraph& graph;
  const Probabilities& found;
  std::span<const Property> properties;
  std::string tree, leaves;  // files; "": there is no leaf file
  std::size_t leaf_count = 0;
  std::vector<std::string> assumed;
  std::vector<SearchCost> costs = {};  // of a search that did not look at everything
};

std::string to_text(const ProbabilityReport& report);
std::string to_json(const ProbabilityReport& report);

}  // namespace lockstep::host
